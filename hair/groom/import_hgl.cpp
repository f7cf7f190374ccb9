#include "hair/groom/import_hgl.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string>

#include "engine/error.h"

namespace hair {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is read as it lies in memory");
static_assert(sizeof(glm::vec3) == 12 && sizeof(std::array<std::uint32_t, 3>) == 12);

constexpr std::size_t kHeaderSize = 3 * sizeof(std::int32_t);
constexpr std::size_t kTripleSize = 12;  // a point or a triangle
constexpr std::int32_t kMaximumSegments = 255;

struct Header {
    std::int32_t strands;
    std::int32_t segments;
    std::int32_t triangles;
};

[[noreturn]] void fail(std::size_t offset, const std::string& reason) {
    throw engine::Error("byte " + std::to_string(offset), reason);
}

Header readHeader(std::span<const std::byte> bytes) {
    if (bytes.size() < kHeaderSize) {
        fail(
            bytes.size(),
            "truncated: the header alone is " + std::to_string(kHeaderSize) + " bytes");
    }
    Header header{};
    std::memcpy(&header, bytes.data(), kHeaderSize);
    if (header.strands < 1) {
        fail(0, std::to_string(header.strands) + " strands, at least 1 is needed");
    }
    if (header.segments < 1 || header.segments > kMaximumSegments) {
        fail(
            4, std::to_string(header.segments) + " segments is outside [1, " +
                   std::to_string(kMaximumSegments) + "]");
    }
    if (header.triangles < 0) fail(8, std::to_string(header.triangles) + " triangles is negative");
    return header;
}

// The counts are at most 2^31 and 2^8, so the size fits in 64 bits.
void checkSize(const Header& header, std::uint64_t size) {
    const auto strands = static_cast<std::uint64_t>(header.strands);
    const auto vertices = static_cast<std::uint64_t>(header.segments) + 1;
    const auto triangles = static_cast<std::uint64_t>(header.triangles);
    const std::uint64_t expected = kHeaderSize + kTripleSize * (strands * vertices + triangles);
    if (size < expected) {
        fail(
            size, "truncated: " + std::to_string(strands) + " strands of " +
                      std::to_string(vertices) + " vertices and " + std::to_string(triangles) +
                      " triangles are " + std::to_string(expected) + " bytes");
    }
    if (size > expected) {
        fail(expected, std::to_string(size - expected) + " trailing bytes after the last triangle");
    }
}

void checkPoints(const Groom& groom) {
    for (std::size_t i = 0; i < groom.points.size(); ++i) {
        const glm::vec3& p = groom.points[i];
        if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
        fail(
            kHeaderSize + kTripleSize * i,
            "strand " + std::to_string(i / groom.vertices_per_strand) + ", vertex " +
                std::to_string(i % groom.vertices_per_strand) + " is not finite");
    }
}

void checkTriangles(const Groom& groom) {
    for (std::size_t i = 0; i < groom.root_triangles.size(); ++i) {
        const auto& [a, b, c] = groom.root_triangles[i];
        const std::size_t offset = kHeaderSize + kTripleSize * (groom.points.size() + i);
        for (const std::uint32_t guide : {a, b, c}) {
            if (guide >= groom.strand_count) {
                fail(
                    offset, "triangle " + std::to_string(i) + " names strand " +
                                std::to_string(static_cast<std::int32_t>(guide)) + ", there are " +
                                std::to_string(groom.strand_count));
            }
        }
        if (a == b || b == c || c == a) {
            fail(offset, "triangle " + std::to_string(i) + " names a strand twice");
        }
    }
}

std::vector<std::byte> readFile(const std::filesystem::path& path) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) throw engine::Error("no such file");
    if (!std::filesystem::is_regular_file(path, error)) throw engine::Error("not a file");
    std::vector<std::byte> bytes(std::filesystem::file_size(path, error));
    std::ifstream file(path, std::ios::binary);
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (error || !file) throw engine::Error("can't be read");
    return bytes;
}

}  // namespace

Groom parseHgl(std::span<const std::byte> bytes) {
    const Header header = readHeader(bytes);
    checkSize(header, bytes.size());
    Groom groom;
    groom.strand_count = static_cast<std::uint32_t>(header.strands);
    groom.vertices_per_strand = static_cast<std::uint32_t>(header.segments) + 1;
    groom.points.resize(std::size_t{groom.strand_count} * groom.vertices_per_strand);
    groom.root_triangles.resize(static_cast<std::size_t>(header.triangles));
    const std::size_t points_size = groom.points.size() * kTripleSize;
    std::memcpy(groom.points.data(), bytes.data() + kHeaderSize, points_size);
    if (!groom.root_triangles.empty()) {
        std::memcpy(
            groom.root_triangles.data(), bytes.data() + kHeaderSize + points_size,
            groom.root_triangles.size() * kTripleSize);
    }
    checkPoints(groom);
    checkTriangles(groom);
    return groom;
}

Groom importHgl(const std::filesystem::path& path) {
    try {
        return parseHgl(readFile(path));
    } catch (const engine::Error& error) {
        throw engine::Error(path.string(), error.what());
    }
}

}  // namespace hair
