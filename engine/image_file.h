#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace engine {

// A picture in memory, as files hold it.
struct Pixels {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> rgba;  // [row][column][channel], top row first
};

// One of light: linear RGB without bounds.
struct FloatPixels {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<float> rgb;  // [row][column][channel], top row first
};

// Reads a PNG, JPEG, TGA or BMP of at most 2^26 pixels; what has no alpha gets 255, and 16 bits
// become 8. Throws Error that names the file.
Pixels readImage(const std::filesystem::path& path);

// Writes a PNG of RGBA pixels, [row][column], top row first; creates the folder. Throws Error.
void writePng(
    const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
    std::span<const std::uint8_t> rgba);

}  // namespace engine
