#include "engine/pictures.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <string_view>

#include "engine/error.h"
#include "engine/files.h"
#include "engine/png_text.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_TGA
#define STBI_ONLY_BMP
#include <stb/stb_image.h>

namespace engine {
namespace {

// Upper bounds on pixels per byte, for memory that stb allocates before it looks at the pixels.
// PNG: deflate makes at most 1032 bytes from one, with 8 pixels each. JPEG: a block of 64 pixels
// takes at least one bit, and with two channels each may store only every fourth pixel. Other
// formats have fewer.
constexpr std::int64_t kMostPixelsPerByteOfPng = 8 * 1032;
constexpr std::int64_t kMostPixelsPerByte = 1024;

// The Huffman tables of a JPEG. stb assumes without a check that a table has at most as many codes
// as a byte has values, or else writes past the end of its own table, and that a scan's tables
// exist.
class HuffmanTables {
public:
    // A segment of tables. Each has its class and number, 16 counts of codes of 1 to 16 bits, and a
    // value per code.
    void define(std::string_view tables) {
        constexpr std::size_t kHead = 17;  // bytes before the values
        constexpr std::size_t kMostCodes = 256;
        while (!tables.empty()) {
            std::size_t codes = 0;
            for (const char count : tables.substr(1, kHead - 1))
                codes += static_cast<unsigned char>(count);
            if (codes > kMostCodes)
                throw Error("a Huffman table has " + std::to_string(codes) + " codes");
            if (tables.size() < kHead + codes) throw Error("a Huffman table is cut off");
            defined_.insert(static_cast<unsigned char>(tables.front()));
            tables.remove_prefix(kHead + codes);
        }
    }

    // A scan header: the number of channels, each with its tables, and the coefficients. A
    // progressive scan has either the first coefficients (DC), which need a table only in their
    // first pass, or the others (AC).
    void check(std::string_view scan, bool progressive) const {
        const auto byteAt = [&](std::size_t at) {
            return at < scan.size() ? int{static_cast<unsigned char>(scan[at])} : 0;
        };
        const auto channels = static_cast<std::size_t>(byteAt(0));
        if (scan.size() != 4 + 2 * channels) return;  // stb rejects it
        const bool first = byteAt(1 + 2 * channels) == 0;
        const bool refines = byteAt(3 + 2 * channels) >> 4 != 0;
        constexpr int kOthers = 0x10;  // class bit of AC tables
        for (std::size_t i = 0; i < channels; ++i) {
            const int tables = byteAt(2 + 2 * i);
            const bool has_first = defined_.contains(tables >> 4);
            const bool has_others = defined_.contains(kOthers | (tables & 0xf));
            const bool needs_first = progressive ? first && !refines : true;
            const bool needs_others = progressive ? !first : true;
            if ((needs_first && !has_first) || (needs_others && !has_others))
                throw Error("a scan names a Huffman table that is not defined");
        }
    }

private:
    std::set<int> defined_;
};

bool isJpeg(std::string_view file) {
    const std::size_t start = file.find_first_not_of('\xff');
    return start != 0 && start < file.size() && file[start] == '\xd8';
}

// Walks through the segments of a JPEG, including those after coded data, where 0xff is followed by
// 0 or by a restart marker (ITU-T T.81, annex B). stb finds no others.
void checkJpegTables(std::string_view file) {
    constexpr int kProgressive = 0xc2;
    constexpr int kHuffmanTables = 0xc4;
    constexpr int kEnd = 0xd9;
    constexpr int kScan = 0xda;
    HuffmanTables tables;
    bool progressive = false;
    const auto byteAt = [&](std::size_t at) { return int{static_cast<unsigned char>(file[at])}; };
    for (std::size_t at = file.find('\xff'); at < file.size(); at = file.find('\xff', at)) {
        at = std::min(file.find_first_not_of('\xff', at), file.size());
        if (file.size() - at < 3 || byteAt(at) == kEnd) return;
        const int mark = byteAt(at++);
        if (mark < 0xc0 || (mark >= 0xd0 && mark < kEnd)) continue;  // a marker without a length
        const auto length = static_cast<std::size_t>(byteAt(at) << 8 | byteAt(at + 1));
        if (length < 2) return;  // stb rejects it
        const std::string_view segment = file.substr(at, length);
        if (segment.size() < 2) return;
        progressive = progressive || mark == kProgressive;
        if (mark == kHuffmanTables) tables.define(segment.substr(2));
        if (mark == kScan) tables.check(segment.substr(2), progressive);
        at += segment.size();
    }
}

}  // namespace

void checkPictureSize(std::int64_t width, std::int64_t height) {
    constexpr std::int64_t kMostPixels = std::int64_t{1} << 26;
    if (width > 0 && height > 0 && width <= kMostPixels / height) return;
    throw Error(
        "has " + std::to_string(width) + " by " + std::to_string(height) +
        " pixels; expected 1 to 2^26 in all");
}

std::string
encodePng(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba) {
    assert(rgba.size() == std::size_t{4} * width * height);
    std::string bytes;
    const auto append = [](void* to, void* piece, int size) {
        static_cast<std::string*>(to)->append(
            static_cast<const char*>(piece), static_cast<std::size_t>(size));
    };
    if (!stbi_write_png_to_func(
            append, &bytes, static_cast<int>(width), static_cast<int>(height), 4, rgba.data(),
            static_cast<int>(width) * 4)) {
        throw Error("can't be encoded");
    }
    return bytes;
}

Pixels decodeImage(std::string_view file) {
    if (file.size() > std::size_t{std::numeric_limits<int>::max()})
        throw Error("is larger than 2 GiB");
    const auto* data = reinterpret_cast<const stbi_uc*>(file.data());
    const int size = static_cast<int>(file.size());
    int width = 0;
    int height = 0;
    int channels = 0;
    if (isJpeg(file)) checkJpegTables(file);
    if (!stbi_info_from_memory(data, size, &width, &height, &channels))
        throw Error("is not a PNG, JPEG, TGA or BMP");
    checkPictureSize(width, height);
    const std::int64_t most_per_byte = isPng(file) ? kMostPixelsPerByteOfPng : kMostPixelsPerByte;
    if (std::int64_t{width} * height / most_per_byte > static_cast<std::int64_t>(file.size()))
        throw Error("ends too early for a picture of its size");
    if (isPng(file)) checkPngData(file);
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    const std::unique_ptr<stbi_uc, void (*)(void*)> decoded(
        stbi_load_from_memory(data, size, &width, &height, &channels, 4), stbi_image_free);
    if (!decoded) throw Error(std::string("can't be decoded: ") + stbi_failure_reason());
    return {
        static_cast<std::uint32_t>(width),
        static_cast<std::uint32_t>(height),
        {decoded.get(), decoded.get() + 4 * pixels}};
}

Pixels readImage(const std::filesystem::path& path) {
    const std::string bytes = readFile(path);
    try {
        return decodeImage(bytes);
    } catch (const Error& error) {
        throw Error(path.string(), error.what());
    }
}

void writePng(
    const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
    std::span<const std::uint8_t> rgba) {
    std::string bytes;
    try {
        bytes = encodePng(width, height, rgba);
    } catch (const Error& error) {
        throw Error(path.string(), error.what());
    }
    writeFileAtomically(path, bytes);
}

// ---- Animations ---------------------------------------------------------------------------------

namespace {

// Two bytes, most significant first.
std::string pngShort(std::uint32_t number) { return pngNumber(number).substr(2); }

// Returns seconds as a fraction of two numbers of 16 bits. A fraction of one, such as a 60th, is
// exact.
std::string pngDelay(double seconds) {
    constexpr double kLongest = 65535.0;
    const double rate = std::round(1.0 / std::max(seconds, 1.0 / kLongest));
    if (rate >= 1.0 && std::abs(rate * seconds - 1.0) < 1e-4)
        return pngShort(1) + pngShort(static_cast<std::uint32_t>(rate));
    const double milliseconds = std::clamp(std::round(1000.0 * seconds), 1.0, kLongest);
    return pngShort(static_cast<std::uint32_t>(milliseconds)) + pngShort(1000);
}

std::string imageHeader(std::uint32_t width, std::uint32_t height) {
    using namespace std::string_view_literals;
    std::string data = pngNumber(width) + pngNumber(height);
    data += "\x08\x06\0\0\0"sv;  // 8 bits, RGBA, deflate, adaptive filters, not interlaced
    return pngChunk("IHDR", data);
}

std::string animationControl(std::uint32_t pictures) {
    return pngChunk("acTL", pngNumber(pictures) + pngNumber(0));  // 0: repeats without end
}

}  // namespace

AnimatedPng::AnimatedPng(
    const std::filesystem::path& path, std::uint32_t width, std::uint32_t height)
    : path_(path), file_(path, std::ios::binary), width_(width), height_(height) {
    if (!file_) throw Error(path.string(), "cannot be written");
    checkPictureSize(width, height);
}

// Returns the chunks of a picture: the smallest rectangle with all that differs from the last one.
std::string AnimatedPng::changed(std::span<const std::uint8_t> rgba, double seconds) {
    const std::size_t row = std::size_t{4} * width_;
    std::uint32_t left = 0, top = 0, right = width_, bottom = height_;
    if (!last_.empty()) {
        left = width_, top = height_, right = bottom = 0;
        for (std::uint32_t y = 0; y < height_; ++y) {
            const auto now = rgba.subspan(y * row, row);
            const auto before = std::span(last_).subspan(y * row, row);
            const auto from = std::ranges::mismatch(now, before).in1;
            if (from == now.end()) continue;
            const auto first = static_cast<std::uint32_t>((from - now.begin()) / 4);
            std::uint32_t last = width_ - 1;
            while (std::ranges::equal(now.subspan(4 * last, 4), before.subspan(4 * last, 4)))
                --last;
            left = std::min(left, first);
            right = std::max(right, last + 1);
            top = std::min(top, y);
            bottom = y + 1;
        }
        // A picture needs a pixel.
        if (bottom == 0) left = top = 0, right = bottom = 1;
    }
    std::vector<std::uint8_t> part;
    for (std::uint32_t y = top; y < bottom; ++y) {
        const auto pixels = rgba.subspan(y * row + 4 * left, 4 * (right - left));
        part.insert(part.end(), pixels.begin(), pixels.end());
    }
    const std::string data = pngChunks(encodePng(right - left, bottom - top, part), "IDAT");
    std::string control = pngNumber(sequence_++);
    for (const std::uint32_t number : {right - left, bottom - top, left, top})
        control += pngNumber(number);
    control += pngDelay(seconds);
    control += std::string(2, '\0');  // stays, and replaces what it covers
    std::string chunks = pngChunk("fcTL", control);
    if (last_.empty()) return chunks + pngChunk("IDAT", data);
    chunks += pngChunk("fdAT", pngNumber(sequence_) + data);
    ++sequence_;
    return chunks;
}

void AnimatedPng::add(
    std::span<const std::uint8_t> rgba, double seconds, std::string_view keyword,
    std::string_view text) {
    assert(rgba.size() == std::size_t{4} * width_ * height_);
    std::string bytes;
    if (last_.empty()) {
        const std::string head = std::string(kPngSignature) + imageHeader(width_, height_);
        bytes = text.empty() ? head : withPngText(head, keyword, text);
        count_ = static_cast<std::streamoff>(bytes.size());
        bytes += animationControl(1);
    }
    bytes += changed(rgba, seconds);
    const std::string end = pngChunk("IEND", {});
    // First the picture, so that the file never counts more pictures than it has.
    file_.seekp(end_);
    file_ << bytes << end << std::flush;
    file_.seekp(count_);
    file_ << animationControl(pictures_ + 1) << std::flush;
    if (!file_) throw Error(path_.string(), "cannot be written");
    end_ += static_cast<std::streamoff>(bytes.size());
    ++pictures_;
    last_.assign(rgba.begin(), rgba.end());
}

}  // namespace engine
