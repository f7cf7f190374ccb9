#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

// Pictures of linear light in memory, and the reading and writing of their files.
namespace engine {

// A picture of light in memory: linear RGB without bounds.
struct FloatPixels {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<float> rgb;  // [row][column][channel], top row first
};

// Returns the pixels of an OpenEXR file (channels R, G, B or Y; its display window, black where
// there is no data) or of a Radiance HDR file, of at most 2^26 pixels. Assumes sRGB primaries.
// Throws Error; readFloatImage's names the file.
FloatPixels decodeFloatImage(std::string_view file);
FloatPixels readFloatImage(const std::filesystem::path& path);

// Writes linear light as an OpenEXR of single-precision R, G, B, [row][column][channel], top row
// first, with writeFileAtomically. Throws Error.
void writeExr(
    const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
    std::span<const float> rgb);

}  // namespace engine
