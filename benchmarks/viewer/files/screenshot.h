#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace benchmarks {

// A PNG of RGBA pixels, [row][column], top row first, with a scene in its metadata: an iTXt chunk
// "hairbench-scene", from which sceneOfScreenshot() and loadScene() take it. `scene` is what
// sceneText() makes for the picture's folder. In one step. Throws engine::Error.
void writeScreenshot(
    const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
    std::span<const std::uint8_t> rgba, const std::string& scene);

// "hairbench-rest-0001.png" of the stem "hairbench-rest": the first that is free in the folder.
std::filesystem::path freeName(
    const std::filesystem::path& folder, const std::string& stem, const std::string& extension);

}  // namespace benchmarks
