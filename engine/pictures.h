#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Pictures in memory, and the files that they are read from and written to.
namespace engine {

// A picture of display colours in memory, as files hold it.
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

// The pixels of a PNG, JPEG, TGA or BMP file of at most 2^26 pixels; what has no alpha gets 255,
// and 16 bits become 8. Throws Error; readImage's names the file.
Pixels decodeImage(std::string_view file);
Pixels readImage(const std::filesystem::path& path);

// The pixels of an OpenEXR (channels R, G, B or Y; its display window, black where there is no
// data) or a Radiance HDR of at most 2^26 pixels; primaries are taken to be sRGB's. Throws Error;
// readFloatImage's names the file.
FloatPixels decodeFloatImage(std::string_view file);
FloatPixels readFloatImage(const std::filesystem::path& path);

// The bytes of a PNG file of RGBA pixels, [row][column], top row first. Throws Error.
std::string
encodePng(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba);

// Writes a PNG of RGBA pixels, [row][column], top row first, as writeFileAtomically does. Throws
// Error.
void writePng(
    const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
    std::span<const std::uint8_t> rgba);

// Writes linear light as an OpenEXR of single-precision R, G, B, [row][column][channel], top row
// first, as writeFileAtomically does. Throws Error.
void writeExr(
    const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
    std::span<const float> rgb);

}  // namespace engine
