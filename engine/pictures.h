#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
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

// An animated PNG that repeats without end, written picture by picture and lossless: browsers play
// it (PNG, third edition, section 11.3.6). After each picture the file is complete.
class AnimatedPng {
public:
    // Creates the file, or empties it. Throws Error "<path>: reason", as add() does.
    AnimatedPng(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height);

    // Adds a picture of RGBA pixels, [row][column], top row first, shown for `seconds`. Writes the
    // part that differs from the picture before. `text` of the first picture becomes an iTXt chunk
    // by `keyword`, as by withPngText(); empty: none.
    void
    add(std::span<const std::uint8_t> rgba, double seconds, std::string_view keyword = {},
        std::string_view text = {});

    std::uint32_t pictures() const { return pictures_; }
    std::uintmax_t size() const { return static_cast<std::uintmax_t>(end_); }  // bytes of the file

private:
    std::string changed(std::span<const std::uint8_t> rgba, double seconds);

    std::filesystem::path path_;
    std::ofstream file_;
    std::uint32_t width_ = 0;
    std::uint32_t height_ = 0;
    std::vector<std::uint8_t> last_;  // the picture before; empty: none
    std::uint32_t pictures_ = 0;
    std::uint32_t sequence_ = 0;  // number of the next chunk of the animation
    std::streamoff count_ = 0;  // place of the chunk that counts pictures
    std::streamoff end_ = 0;
};

// Throws Error, which doesn't name the file, for a picture without pixels or with more than 2^26.
void checkPictureSize(std::int64_t width, std::int64_t height);

}  // namespace engine
