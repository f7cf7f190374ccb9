#include "hair/groom/mesh/glb_file.h"

#include <array>
#include <cstdint>
#include <cstring>

#include "engine/error.h"

namespace hair {
namespace {

constexpr std::string_view kMagic = "glTF";
constexpr std::size_t kHeaderSize = 12;      // magic, version, length
constexpr std::size_t kChunkHeaderSize = 8;  // length, type
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

[[noreturn]] void fail(std::size_t byte, const std::string& reason) {
    throw engine::Error("byte " + std::to_string(byte), reason);
}

std::uint32_t wordAt(std::string_view file, std::size_t offset) {
    std::array<unsigned char, 4> b{};
    std::memcpy(b.data(), file.data() + offset, b.size());
    return b[0] | (std::uint32_t{b[1]} << 8) | (std::uint32_t{b[2]} << 16) |
           (std::uint32_t{b[3]} << 24);
}

void appendWord(std::string& file, std::size_t word) {
    for (int shift = 0; shift < 32; shift += 8) file += static_cast<char>(word >> shift & 0xff);
}

// The data of a chunk.
std::string_view chunkAt(std::string_view file, std::size_t offset, std::uint32_t type) {
    if (file.size() - offset < kChunkHeaderSize) {
        fail(file.size(), "truncated: a chunk's header is expected");
    }
    const std::size_t size = wordAt(file, offset);
    if (wordAt(file, offset + 4) != type) {
        fail(offset + 4, std::string("the chunk isn't ") + (type == kJsonChunk ? "JSON" : "BIN"));
    }
    if (size > file.size() - offset - kChunkHeaderSize) {
        fail(
            offset, "truncated: the chunk has " + std::to_string(size) + " bytes, " +
                        std::to_string(file.size() - offset - kChunkHeaderSize) + " are there");
    }
    return file.substr(offset + kChunkHeaderSize, size);
}

void appendChunk(std::string& file, std::uint32_t type, std::string_view data, char padding) {
    const std::size_t padded = (data.size() + 3) / 4 * 4;
    appendWord(file, padded);
    appendWord(file, type);
    file.append(data).append(padded - data.size(), padding);
}

}  // namespace

bool isGlb(std::string_view file) { return file.starts_with(kMagic); }

// tinygltf looks for the end of the second chunk 8 bytes too late.
GlbChunks glbChunks(std::string_view file) {
    if (file.size() < kHeaderSize) fail(file.size(), "truncated: the header alone is 12 bytes");
    const std::uint32_t version = wordAt(file, 4);
    const std::uint32_t length = wordAt(file, 8);
    if (version != 2) fail(4, "version " + std::to_string(version) + " of glTF, expected 2");
    if (length != file.size()) {
        fail(
            8, "the header says that there are " + std::to_string(length) + " bytes, there are " +
                   std::to_string(file.size()));
    }
    const std::string_view json = chunkAt(file, kHeaderSize, kJsonChunk);
    const std::size_t end = kHeaderSize + kChunkHeaderSize + json.size();
    if (end == file.size()) return {json, {}};
    return {json, chunkAt(file, end, kBinaryChunk)};
}

std::string glbFile(const GlbChunks& chunks) {
    std::string data;
    data.reserve(chunks.json.size() + chunks.binary.size() + 64);
    data.append(kMagic);
    appendWord(data, 2);
    appendWord(data, 0);
    appendChunk(data, kJsonChunk, chunks.json, ' ');
    if (!chunks.binary.empty()) appendChunk(data, kBinaryChunk, chunks.binary, '\0');
    std::string length;
    appendWord(length, data.size());
    return data.replace(8, 4, length);
}

}  // namespace hair
