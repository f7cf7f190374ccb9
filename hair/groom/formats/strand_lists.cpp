#include "hair/groom/formats/formats.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/error.h"
#include "hair/groom/formats/binary_file.h"
#include "hair/groom/formats/text.h"

namespace hair::groom {
namespace {

constexpr std::uint64_t kCountSize = sizeof(std::int32_t);

// Bytes of a point, which begins with its position.
constexpr std::uint64_t kDataPoint = 3 * sizeof(float);
constexpr std::uint64_t kCt2HairPoint = 7 * sizeof(float);

// The place of a strand's points in the file.
struct ListedStrand {
    std::uint32_t number;
    std::uint64_t start;  // byte of the first point
    std::uint32_t points;
};

std::uint32_t
countAt(std::span<const std::byte> bytes, std::uint64_t offset, const std::string& of_what) {
    if (bytes.size() - offset < kCountSize)
        failAt(
            bytes.size(),
            "truncated: " + of_what + " is expected at byte " + std::to_string(offset));
    const auto count = valueAt<std::int32_t>(bytes, offset);
    if (count < 0) failAt(offset, of_what + " is negative: " + std::to_string(count));
    return static_cast<std::uint32_t>(count);
}

// Lists the strands of the file, which must be exactly as long as they are.
std::vector<ListedStrand> listStrands(std::span<const std::byte> bytes, std::uint64_t point_size) {
    const std::uint32_t count = countAt(bytes, 0, "the number of strands");
    if (count == 0) failAt(0, "0 strands; at least 1 is needed");
    if (count > (bytes.size() - kCountSize) / kCountSize) {
        failAt(
            0, "truncated: " + std::to_string(count) + " strands are more than " +
                   std::to_string(bytes.size()) + " bytes can hold");
    }
    std::vector<ListedStrand> strands;
    strands.reserve(count);
    std::uint64_t end = kCountSize;
    std::uint64_t points = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t size =
            countAt(bytes, end, "the number of points of strand " + std::to_string(i));
        const std::uint64_t start = end + kCountSize;
        end = start + size * point_size;
        if (end > bytes.size()) {
            failAt(
                start - kCountSize, "truncated: strand " + std::to_string(i) + " of " +
                                        std::to_string(size) + " points ends at byte " +
                                        std::to_string(end) + ", but the file ends at byte " +
                                        std::to_string(bytes.size()));
        }
        points += size;
        if (points > std::numeric_limits<std::uint32_t>::max())
            failAt(start - kCountSize, "the strands have 2^32 points, or more");
        strands.push_back({i, start, size});
    }
    if (end != bytes.size())
        failAt(end, std::to_string(bytes.size() - end) + " trailing bytes after the last strand");
    return strands;
}

}  // namespace

std::vector<std::string> exportHairData(const StrandSet& strands, std::ostream& out) {
    if (strands.ends.empty()) throw engine::Error("there are no strands");
    constexpr std::uint32_t kMost = std::numeric_limits<std::int32_t>::max();
    if (strands.strandCount() > kMost || greatestSize(strands) > kMost)
        throw engine::Error("more strands, or points of a strand, than an int32 can hold");
    writeValue(out, strands.strandCount());
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i) {
        writeValue(out, strands.size(i));
        const auto points = std::as_bytes(strands.strand(i));
        out.write(
            reinterpret_cast<const char*>(points.data()),
            static_cast<std::streamsize>(points.size()));
    }
    return leftOut(strands, {});
}

StrandSet importHairData(const StrandFile& file) {
    const std::vector<ListedStrand> listed = listStrands(file.bytes, kDataPoint);
    StrandSet set;
    set.ends.reserve(listed.size());
    // All bytes except the counts are points, and none are left out.
    set.points.reserve((file.bytes.size() - kCountSize * (listed.size() + 1)) / kDataPoint);
    for (const ListedStrand& strand : listed) {
        const std::size_t first = set.points.size();
        set.points.resize(first + strand.points);
        if (strand.points > 0)
            std::memcpy(
                &set.points[first], file.bytes.data() + strand.start,
                std::size_t{strand.points} * sizeof(glm::vec3));
        set.ends.push_back(static_cast<std::uint32_t>(set.points.size()));
    }
    return set;
}

StrandSet importCt2Hair(const StrandFile& file) {
    constexpr std::uint32_t kLeastPoints = 5;
    const std::vector<ListedStrand> listed = listStrands(file.bytes, kCt2HairPoint);
    StrandSet set;
    set.ends.reserve(listed.size());
    set.points.reserve((file.bytes.size() - kCountSize * (listed.size() + 1)) / kCt2HairPoint);
    bool has_more = false;
    for (const ListedStrand& strand : listed) {
        if (strand.points < kLeastPoints)
            set.faults.push_back({strand.number, "of fewer than 5 points"});
        for (std::uint32_t k = 0; k < strand.points; ++k) {
            const std::uint64_t start = strand.start + k * kCt2HairPoint;
            set.points.push_back(valueAt<glm::vec3>(file.bytes, start));
            const auto beside = valueAt<glm::vec3>(file.bytes, start + sizeof(glm::vec3));
            has_more = has_more || beside != glm::vec3(0.0f);
        }
        set.ends.push_back(static_cast<std::uint32_t>(set.points.size()));
    }
    if (has_more) set.warnings.emplace_back("the points' tangents, or colours, are left out");
    return set;
}

// ---- Counts, then points ------------------------------------------------------------------------

namespace {

constexpr std::uint64_t kCounts = 2 * sizeof(std::uint32_t);  // bytes before the strands' sizes

}  // namespace

bool looksLikeCountedHair(std::span<const std::byte> head, std::uint64_t size) {
    if (head.size() < kCounts || size < kCounts) return false;
    const auto strands = valueAt<std::uint32_t>(head, 0);
    return strands > 0 && strands <= (size - kCounts) / sizeof(std::uint16_t);
}

StrandSet importCountedHair(const StrandFile& file) {
    const std::span bytes = file.bytes;
    if (bytes.size() < kCounts)
        failAt(bytes.size(), "truncated: the numbers of strands and points are 8 bytes");
    const auto strands = valueAt<std::uint32_t>(bytes, 0);
    const auto stated = valueAt<std::uint32_t>(bytes, sizeof(std::uint32_t));
    if (strands == 0) failAt(0, "0 strands; at least 1 is needed");
    if (strands > (bytes.size() - kCounts) / sizeof(std::uint16_t)) {
        failAt(
            0, "truncated: " + std::to_string(strands) + " strands are more than " +
                   std::to_string(bytes.size()) + " bytes can hold");
    }
    StrandSet set;
    set.ends.reserve(strands);
    std::uint64_t points = 0;
    for (const std::uint16_t size : arrayAt<std::uint16_t>(bytes, kCounts, strands)) {
        points += size;
        if (points > std::numeric_limits<std::uint32_t>::max())
            failAt(kCounts, "the strands have 2^32 points, or more");
        set.ends.push_back(static_cast<std::uint32_t>(points));
    }
    const std::uint64_t start = kCounts + sizeof(std::uint16_t) * std::uint64_t{strands};
    const std::uint64_t end = start + kDataPoint * points;
    const std::string sizes = std::to_string(strands) + " strands of " + std::to_string(points) +
                              " points without a header are " + std::to_string(end) + " bytes";
    if (bytes.size() < end) failAt(bytes.size(), "truncated: " + sizes);
    if (bytes.size() > end)
        failAt(
            end,
            std::to_string(bytes.size() - end) + " trailing bytes after the last point: " + sizes);
    set.points = arrayAt<glm::vec3>(bytes, start, points);
    if (stated != points)
        set.warnings.push_back(
            "the file states " + std::to_string(stated) + " points, but its strands have " +
            std::to_string(points));
    return set;
}

}  // namespace hair::groom
