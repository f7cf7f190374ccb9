#include "engine/png_text.h"

#include <array>
#include <cassert>
#include <cstdint>

#include <zlib.h>

#include "engine/error.h"

namespace engine {
namespace {

using namespace std::string_view_literals;

constexpr std::size_t kFrame = 12;  // bytes of a chunk besides its data: length, type, checksum
constexpr std::size_t kHeaderChunk = kFrame + 13;          // IHDR and its data
constexpr std::size_t kLongestText = std::size_t{64} << 20;  // bytes

struct Chunk {
    std::string_view type;
    std::string_view data;
};

[[noreturn]] void fail(std::size_t byte, const std::string& reason) {
    throw Error("byte " + std::to_string(byte), reason);
}

const Bytef* bytesOf(std::string_view text) { return reinterpret_cast<const Bytef*>(text.data()); }

// Returns the checksum of a chunk's type and data, which are adjacent.
std::uint32_t checksum(std::string_view type_and_data) {
    return static_cast<std::uint32_t>(
        crc32_z(crc32_z(0, nullptr, 0), bytesOf(type_and_data), type_and_data.size()));
}

std::uint32_t bigEndian(std::string_view bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
}

// Returns the chunk at `at` and moves `at` past it.
Chunk readChunk(std::string_view file, std::size_t& at) {
    const std::string_view rest = file.substr(at);
    if (rest.size() < kFrame) fail(at, "the file ends before its last chunk");
    const std::size_t length = bigEndian(rest);
    if (length > rest.size() - kFrame) fail(at, "the file ends in the middle of a chunk");
    if (checksum(rest.substr(4, 4 + length)) != bigEndian(rest.substr(8 + length)))
        fail(at, "the checksum of the chunk is wrong");
    at += kFrame + length;
    return {rest.substr(4, 4), rest.substr(8, length)};
}

// Removes the text up to the next zero byte, with that byte, and returns the text.
std::string_view takeUpToZero(std::string_view& data, std::size_t at) {
    const std::size_t zero = data.find('\0');
    if (zero == std::string_view::npos) fail(at, "the chunk of text is cut off");
    const std::string_view taken = data.substr(0, zero);
    data.remove_prefix(zero + 1);
    return taken;
}

// Ends an inflation in any case.
struct Inflation {
    z_stream stream{};
    ~Inflation() { inflateEnd(&stream); }
};

void start(z_stream& stream) {
    if (inflateInit(&stream) != Z_OK) throw Error("zlib can't be started");
}

std::string inflated(std::string_view data, std::size_t at) {
    Inflation inflation;
    z_stream& stream = inflation.stream;
    start(stream);
    stream.next_in = const_cast<Bytef*>(bytesOf(data));  // zlib's type; it only reads
    stream.avail_in = static_cast<uInt>(data.size());
    std::string text;
    std::array<char, 1 << 14> piece{};
    for (int state = Z_OK; state != Z_STREAM_END;) {
        stream.next_out = reinterpret_cast<Bytef*>(piece.data());
        stream.avail_out = static_cast<uInt>(piece.size());
        state = inflate(&stream, Z_NO_FLUSH);
        if (state != Z_OK && state != Z_STREAM_END) fail(at, "the compressed text is damaged");
        text.append(piece.data(), piece.size() - stream.avail_out);
        if (text.size() > kLongestText) fail(at, "the compressed text is longer than 64 MiB");
    }
    return text;
}

// Returns the text after the keyword. `at`: offset of the chunk, for errors.
std::string textOf(std::string_view type, std::string_view data, std::size_t at) {
    if (type == "tEXt") return std::string(data);
    bool compressed = type == "zTXt";
    char method = 0;
    if (compressed) {
        if (data.empty()) fail(at, "the chunk of text is cut off");
        method = data[0];
        data.remove_prefix(1);
    } else {
        if (data.size() < 2) fail(at, "the chunk of text is cut off");
        compressed = data[0] != 0;
        method = data[1];
        data.remove_prefix(2);
        takeUpToZero(data, at);  // the language
        takeUpToZero(data, at);  // the translated keyword
    }
    if (!compressed) return std::string(data);
    if (method != 0) fail(at, "the text is compressed with an unknown method");
    return inflated(data, at);
}

}  // namespace

std::string pngNumber(std::uint32_t number) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 0xff);
    return bytes;
}

std::string pngChunk(std::string_view type, std::string_view data) {
    std::string chunk(type);
    chunk += data;
    return pngNumber(static_cast<std::uint32_t>(data.size())) + chunk + pngNumber(checksum(chunk));
}

std::string pngChunks(std::string_view file, std::string_view type) {
    if (!isPng(file)) fail(0, "is not a PNG");
    std::string data;
    std::size_t at = kPngSignature.size();
    for (Chunk chunk; chunk.type != "IEND";) {
        chunk = readChunk(file, at);
        if (chunk.type == type) data += chunk.data;
    }
    return data;
}

bool isPng(std::string_view file) { return file.starts_with(kPngSignature); }

std::string withPngText(std::string_view file, std::string_view keyword, std::string_view text) {
    assert(isPng(file) && file.size() >= kPngSignature.size() + kHeaderChunk);
    assert(!keyword.empty() && keyword.size() < 80 && text.find('\0') == text.npos);
    std::string data(keyword);
    data.append("\0\0\0\0\0"sv).append(text);  // not compressed, no language
    const std::size_t place = kPngSignature.size() + kHeaderChunk;
    return std::string(file.substr(0, place)) + pngChunk("iTXt", data) +
           std::string(file.substr(place));
}

std::optional<std::string> pngText(std::string_view file, std::string_view keyword) {
    if (!isPng(file)) fail(0, "is not a PNG");
    std::optional<std::string> found;
    std::size_t at = kPngSignature.size();
    for (std::string_view type; type != "IEND";) {
        const std::size_t begin = at;
        Chunk chunk = readChunk(file, at);
        type = chunk.type;
        if (found || (type != "iTXt" && type != "tEXt" && type != "zTXt")) continue;
        if (takeUpToZero(chunk.data, begin) == keyword) found = textOf(type, chunk.data, begin);
    }
    return found;
}

namespace {

// Returns the bytes of all rows, each with its filter byte (section 11.2.1). Interlaced ones take a
// little more.
std::uint64_t rowBytes(std::string_view header, std::size_t at) {
    constexpr std::array<std::uint64_t, 7> kChannels{1, 0, 3, 1, 2, 0, 4};  // by colour type
    if (header.size() != 13) fail(at, "the header is cut off");
    const auto type = static_cast<unsigned char>(header[9]);
    if (type >= kChannels.size()) fail(at, "the type of colours is unknown");
    const std::uint64_t bits = kChannels[type] * static_cast<unsigned char>(header[8]);
    return bigEndian(header.substr(4)) * (1 + (bigEndian(header) * bits + 7) / 8);
}

}  // namespace

void checkPngData(std::string_view file) {
    if (!isPng(file)) fail(0, "is not a PNG");
    Inflation inflation;
    z_stream& stream = inflation.stream;
    start(stream);
    std::array<char, 1 << 14> piece{};
    std::uint64_t most = 0;
    int state = Z_OK;
    std::size_t at = kPngSignature.size();
    for (std::string_view type; type != "IEND";) {
        const std::size_t begin = at;
        const Chunk chunk = readChunk(file, at);
        type = chunk.type;
        if (begin == kPngSignature.size()) {
            if (type != "IHDR") fail(begin, "the first chunk is not a header");
            most = 2 * rowBytes(chunk.data, begin);
        }
        if (type != "IDAT") continue;
        stream.next_in = const_cast<Bytef*>(bytesOf(chunk.data));  // zlib's type; it only reads
        stream.avail_in = static_cast<uInt>(chunk.data.size());
        while (state == Z_OK && stream.avail_in > 0) {
            stream.next_out = reinterpret_cast<Bytef*>(piece.data());
            stream.avail_out = static_cast<uInt>(piece.size());
            state = inflate(&stream, Z_NO_FLUSH);
            if (state != Z_OK && state != Z_STREAM_END) fail(begin, "the data are damaged");
            if (stream.total_out > most) fail(begin, "the data exceed a picture of this size");
        }
    }
}

}  // namespace engine
