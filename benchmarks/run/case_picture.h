#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace benchmarks {

// Writes a case's picture, [row][column] RGBA, top row first, beside the report, as a PNG at most
// 480 px wide: "<report without extension>.pictures/<index>.png". Returns that file relative to the
// report's folder, with forward slashes. Throws engine::Error "<path>: <reason>".
std::string writeCasePicture(
    std::span<const std::uint8_t> pixels, std::uint32_t width, std::uint32_t height,
    const std::filesystem::path& report, std::size_t index);

}  // namespace benchmarks
