#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Pictures of display colours in memory, and the reading and writing of their files.
namespace engine {

// A picture of display-referred colours in memory, as stored in files.
struct Pixels {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> rgba;  // [row][column][channel], top row first
};

// Returns the pixels of a PNG, JPEG, TGA or BMP file of at most 2^26 pixels. Missing alpha becomes
// 255, and 16 bits become 8. Throws Error; readImage's names the file.
Pixels decodeImage(std::string_view file);
Pixels readImage(const std::filesystem::path& path);

// Returns a PNG file of RGBA pixels, [row][column], top row first. Throws Error.
std::string
encodePng(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba);

// Writes a PNG of RGBA pixels, [row][column], top row first, with writeFileAtomically. Throws
// Error.
void writePng(
    const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
    std::span<const std::uint8_t> rgba);

// Throws Error, which doesn't name the file, for a picture without pixels or with more than 2^26.
void checkPictureSize(std::int64_t width, std::int64_t height);

}  // namespace engine
