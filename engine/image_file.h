#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace engine {

// Writes a PNG of RGBA pixels, [row][column], top row first; creates the folder. Throws Error.
void writePng(
    const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
    std::span<const std::uint8_t> rgba);

}  // namespace engine
