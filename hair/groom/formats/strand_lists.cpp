#include "hair/groom/formats/strand_lists.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>

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

}  // namespace hair::groom
