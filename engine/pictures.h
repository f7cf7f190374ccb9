#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Pictures in memory, and the reading and writing of picture files.
namespace engine {

// A picture of display-referred colours in memory, as stored in files.
struct Pixels {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> rgba;  // [row][column][channel], top row first
};

// A picture of light in memory: linear RGB without bounds.
struct FloatPixels {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<float> rgb;  // [row][column][channel], top row first
};

// Returns the pixels of a PNG, JPEG, TGA or BMP file of at most 2^26 pixels. Missing alpha becomes
// 255, and 16 bits become 8. Throws Error; readImage's names the file.
Pixels decodeImage(std::string_view file);
Pixels readImage(const std::filesystem::path& path);

// Returns the pixels of an OpenEXR file (channels R, G, B or Y; its display window, black where
// there is no data) or of a Radiance HDR file, of at most 2^26 pixels. Assumes sRGB primaries.
// Throws Error; readFloatImage's names the file.
FloatPixels decodeFloatImage(std::string_view file);
FloatPixels readFloatImage(const std::filesystem::path& path);

// Returns a PNG file of RGBA pixels, [row][column], top row first. Throws Error.
std::string
encodePng(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba);

// Writes a PNG of RGBA pixels, [row][column], top row first, with writeFileAtomically. Throws
// Error.
void writePng(
    const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
    std::span<const std::uint8_t> rgba);

// Writes linear light as an OpenEXR of single-precision R, G, B, [row][column][channel], top row
// first, with writeFileAtomically. Throws Error.
void writeExr(
    const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
    std::span<const float> rgb);

}  // namespace engine
