#include "hair/groom/formats/formats.h"

#include <algorithm>
#include <limits>

#include "hair/groom/formats/binary_file.h"
#include "hair/groom/formats/text.h"

namespace hair::groom {
namespace {

// ---- Writing ------------------------------------------------------------------------------------

std::int32_t checkedCount(std::size_t count, const std::string& what) {
    if (count > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
        throw engine::Error(std::to_string(count) + ' ' + what + " are more than .hgl can count");
    return static_cast<std::int32_t>(count);
}

// ---- Reading ------------------------------------------------------------------------------------

struct HglHeader {
    std::int32_t strands;
    std::int32_t segments;
    std::int32_t triangles;
};

using Triangle = std::array<std::uint32_t, 3>;

constexpr std::uint64_t kTripleSize = 12;  // a point or a triangle
static_assert(
    sizeof(HglHeader) == 12 && sizeof(glm::vec3) == kTripleSize && sizeof(Triangle) == kTripleSize);
constexpr std::int32_t kMaximumSegments = 255;

HglHeader readHglHeader(std::span<const std::byte> bytes) {
    if (bytes.size() < sizeof(HglHeader)) {
        failAt(
            bytes.size(),
            "truncated: the header alone is " + std::to_string(sizeof(HglHeader)) + " bytes");
    }
    const auto header = valueAt<HglHeader>(bytes, 0);
    if (header.strands < 1) {
        failAt(0, std::to_string(header.strands) + " strands; at least 1 is needed");
    }
    if (header.segments < 1 || header.segments > kMaximumSegments) {
        failAt(
            4, std::to_string(header.segments) + " segments is outside [1, " +
                   std::to_string(kMaximumSegments) + "]");
    }
    if (header.triangles < 0) {
        failAt(8, std::to_string(header.triangles) + " triangles is negative");
    }
    return header;
}

// The counts are at most 2^31 and 2^8, so the size fits in 64 bits.
void checkSize(const HglHeader& header, std::uint64_t size) {
    const auto strands = static_cast<std::uint64_t>(header.strands);
    const auto vertices = static_cast<std::uint64_t>(header.segments) + 1;
    const auto triangles = static_cast<std::uint64_t>(header.triangles);
    const std::uint64_t expected =
        sizeof(HglHeader) + kTripleSize * (strands * vertices + triangles);
    if (size < expected) {
        failAt(
            size, "truncated: " + std::to_string(strands) + " strands of " +
                      std::to_string(vertices) + " vertices and " + std::to_string(triangles) +
                      " triangles are " + std::to_string(expected) + " bytes");
    }
    if (size > expected) {
        failAt(
            expected, std::to_string(size - expected) + " trailing bytes after the last triangle");
    }
    if (strands * vertices > std::numeric_limits<std::uint32_t>::max()) {
        failAt(0, std::to_string(strands * vertices) + " points; at most 2^32 - 1 are read");
    }
}

void checkTriangles(const StrandSet& strands) {
    const std::uint64_t start = sizeof(HglHeader) + kTripleSize * strands.points.size();
    for (std::size_t i = 0; i < strands.root_triangles.size(); ++i) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t guide = strands.root_triangles[i][corner];
            if (guide < strands.strandCount()) continue;
            failAt(
                start + kTripleSize * i + 4 * corner,
                "triangle " + std::to_string(i) + " names strand " +
                    std::to_string(static_cast<std::int32_t>(guide)) + ", but there are " +
                    std::to_string(strands.strandCount()));
        }
    }
}

}  // namespace

std::vector<std::string> exportHgl(const StrandSet& strands, std::ostream& out) {
    if (strands.ends.empty()) throw engine::Error("there are no strands");
    auto warnings = leftOut(strands, {Part::root_triangles, Part::unit});
    if (strands.metres_per_unit.value_or(1.0) != 1.0) {
        warnings.push_back(
            ".hgl is in metres, and the lengths are written as they are, in units of " +
            std::to_string(*strands.metres_per_unit) + " m");
    }
    const auto resampled = makeUniform(
        strands, {.least = 2, .most = 256, .wanted = std::clamp(greatestSize(strands), 2u, 256u)},
        warnings);
    const StrandSet& uniform = resampled ? *resampled : strands;
    writeValue(out, checkedCount(uniform.strandCount(), "strands"));
    writeValue(out, static_cast<std::int32_t>(uniform.ends.front() - 1));
    writeValue(out, checkedCount(uniform.root_triangles.size(), "root triangles"));
    writeArray(out, uniform.points);
    writeArray(out, uniform.root_triangles);
    return warnings;
}

StrandSet importHgl(const StrandFile& file) {
    const HglHeader header = readHglHeader(file.bytes);
    checkSize(header, file.bytes.size());
    const auto count = static_cast<std::uint32_t>(header.strands);
    const auto vertices = static_cast<std::uint32_t>(header.segments) + 1;
    const std::uint64_t points = std::uint64_t{count} * vertices;
    StrandSet strands{
        .ends = uniformEnds(count, vertices),
        .points = arrayAt<glm::vec3>(file.bytes, sizeof(HglHeader), points),
        .root_triangles = arrayAt<Triangle>(
            file.bytes, sizeof(HglHeader) + kTripleSize * points,
            static_cast<std::uint64_t>(header.triangles)),
        .metres_per_unit = 1.0};
    checkTriangles(strands);
    return strands;
}

}  // namespace hair::groom
