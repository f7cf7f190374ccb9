#include "hair/groom/formats/formats.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include <glm/vec3.hpp>

#include "hair/groom/formats/binary_file.h"
#include "hair/groom/formats/text.h"

namespace hair::groom {
namespace {

// ---- The header ---------------------------------------------------------------------------------

// Bits of HairHeader::arrays.
enum class HairArray : std::uint32_t {
    segments = 1,
    points = 2,
    thickness = 4,
    transparency = 8,
    colors = 16,
};
constexpr std::uint32_t kAllHairArrays = 31;

// The beginning of a .hair file, as it is in memory; formats.h says what follows.
struct HairHeader {
    std::array<char, 4> magic{'H', 'A', 'I', 'R'};
    std::uint32_t hair_count = 0;
    std::uint32_t point_count = 0;
    std::uint32_t arrays = 0;
    // Values that apply if there is no array. The defaults of transparency and colour are those of
    // the format's author.
    std::uint32_t default_segments = 0;
    float default_thickness = 0.0f;  // 0: not known
    float default_transparency = 0.0f;
    glm::vec3 default_color{1.0f, 1.0f, 1.0f};
    std::array<char, 88> info{};  // text, ended by a 0 if it is shorter

    bool has(HairArray array) const { return (arrays & static_cast<std::uint32_t>(array)) != 0; }
    void add(HairArray array) { arrays |= static_cast<std::uint32_t>(array); }
};
static_assert(sizeof(HairHeader) == 128);
static_assert(offsetof(HairHeader, default_color) == 28 && offsetof(HairHeader, info) == 40);

// ---- Writing ------------------------------------------------------------------------------------

std::vector<std::uint16_t> segmentsOf(const StrandSet& strands) {
    constexpr std::uint32_t kMost = std::numeric_limits<std::uint16_t>::max();
    if (greatestSize(strands) - 1 > kMost) {
        throw engine::Error(
            "a strand of " + std::to_string(greatestSize(strands)) +
            " points among others: .hair holds at most " + std::to_string(kMost + 1));
    }
    std::vector<std::uint16_t> segments(strands.strandCount());
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i)
        segments[i] = static_cast<std::uint16_t>(strands.size(i) - 1);
    return segments;
}

// Puts a value that holds everywhere into the header, or states there that each point has a value.
template <class Value>
void setAttribute(
    HairHeader& header, HairArray array, Value HairHeader::* everywhere,
    const PointAttribute<Value>& attribute) {
    if (!attribute.values.empty()) {
        header.add(array);
    } else if (attribute.everywhere) {
        header.*everywhere = *attribute.everywhere;
    }
}

void setInfo(HairHeader& header, std::string comment, std::vector<std::string>& warnings) {
    const std::size_t most = header.info.size() - 1;  // readers expect a 0 at the end
    if (comment.size() > most) {
        warnings.push_back(
            "the comment of " + std::to_string(comment.size()) + " bytes is cut to " +
            std::to_string(most));
        comment.resize(most);
    }
    std::ranges::copy(comment, header.info.begin());
}

// ---- Reading ------------------------------------------------------------------------------------

HairHeader readHairHeader(std::span<const std::byte> bytes) {
    if (bytes.size() < sizeof(HairHeader)) {
        failAt(
            bytes.size(),
            "truncated: the header alone is " + std::to_string(sizeof(HairHeader)) + " bytes");
    }
    const auto header = valueAt<HairHeader>(bytes, 0);
    const std::string arrays = "arrays " + std::to_string(header.arrays);
    if (header.magic != HairHeader{}.magic) failAt(0, "a .hair file begins with \"HAIR\"");
    if (header.hair_count == 0) failAt(4, "0 strands; at least 1 is needed");
    if ((header.arrays & ~kAllHairArrays) != 0)
        failAt(12, arrays + ": only the bits 0 to 4 are known");
    if (!header.has(HairArray::points))
        failAt(12, arrays + ": bit 1 is not set, so there are no points");
    return header;
}

// The places of the arrays; absent arrays have size 0. The counts are less than 2^32, so all sums
// fit in 64 bits.
struct Layout {
    explicit Layout(const HairHeader& header) {
        const auto place = [&](HairArray array, std::uint64_t size) {
            return std::exchange(end, end + (header.has(array) ? size : 0));
        };
        const std::uint64_t count = header.point_count;
        segments = place(HairArray::segments, std::uint64_t{2} * header.hair_count);
        points = place(HairArray::points, 12 * count);
        thickness = place(HairArray::thickness, 4 * count);
        transparency = place(HairArray::transparency, 4 * count);
        colors = place(HairArray::colors, 12 * count);
    }
    std::uint64_t end = sizeof(HairHeader);  // of the file
    std::uint64_t segments, points, thickness, transparency, colors;
};

void checkSize(const HairHeader& header, const Layout& layout, std::uint64_t size) {
    if (size < layout.end) {
        failAt(
            size, "truncated: " + std::to_string(header.hair_count) + " strands and " +
                      std::to_string(header.point_count) + " points with arrays " +
                      std::to_string(header.arrays) + " are " + std::to_string(layout.end) +
                      " bytes");
    }
    if (size > layout.end) {
        failAt(
            layout.end, std::to_string(size - layout.end) + " trailing bytes after the last array");
    }
}

std::vector<std::uint32_t> defaultEnds(const HairHeader& header) {
    const std::uint64_t size = std::uint64_t{header.default_segments} + 1;
    if (size * header.hair_count != header.point_count) {
        failAt(
            8, std::to_string(header.point_count) + " points, but " +
                   std::to_string(header.hair_count) + " strands of " +
                   std::to_string(header.default_segments) + " segments have " +
                   std::to_string(size * header.hair_count));
    }
    return uniformEnds(header.hair_count, static_cast<std::uint32_t>(size));
}

std::vector<std::uint32_t>
readEnds(const HairHeader& header, std::uint64_t start, std::span<const std::byte> bytes) {
    std::vector<std::uint32_t> ends(header.hair_count);
    std::uint64_t end = 0;
    for (std::uint32_t i = 0; i < header.hair_count; ++i) {
        const std::uint64_t offset = start + std::uint64_t{2} * i;
        end += std::uint64_t{valueAt<std::uint16_t>(bytes, offset)} + 1;
        if (end > header.point_count) {
            failAt(
                offset, "strand " + std::to_string(i) + " ends after point " + std::to_string(end) +
                            ", but there are " + std::to_string(header.point_count));
        }
        ends[i] = static_cast<std::uint32_t>(end);
    }
    if (end != header.point_count) {
        failAt(
            8, std::to_string(header.point_count) + " points, but the strands' segments make " +
                   std::to_string(end));
    }
    return ends;
}

// The source of an attribute: an array, or the header's value for all points.
template <class Value>
struct Source {
    HairArray array;
    std::uint64_t start;  // of the array
    Value everywhere;
};

template <class Value>
PointAttribute<Value> readAttribute(
    const Source<Value>& source, const HairHeader& header, std::span<const std::byte> bytes) {
    PointAttribute<Value> attribute;
    if (header.has(source.array)) {
        attribute.values = arrayAt<Value>(bytes, source.start, header.point_count);
    } else {
        attribute.everywhere = source.everywhere;
    }
    return attribute;
}

PointAttribute<float>
readWidths(const HairHeader& header, const Layout& layout, std::span<const std::byte> bytes) {
    const Source<float> source{HairArray::thickness, layout.thickness, header.default_thickness};
    auto widths = readAttribute(source, header, bytes);
    if (widths.everywhere == 0.0f) widths.everywhere.reset();
    return widths;
}

std::string textOf(const std::array<char, 88>& info) {
    return {info.begin(), std::ranges::find(info, '\0')};
}

}  // namespace

std::vector<std::string> exportHair(const StrandSet& strands, std::ostream& out) {
    if (strands.ends.empty()) throw engine::Error("there are no strands");
    auto warnings =
        leftOut(strands, {Part::widths, Part::transparencies, Part::colors, Part::comment});
    HairHeader header{
        .hair_count = strands.strandCount(),
        .point_count = static_cast<std::uint32_t>(strands.points.size())};
    std::vector<std::uint16_t> segments;
    if (const auto size = commonSize(strands)) {
        header.default_segments = *size - 1;
    } else {
        header.add(HairArray::segments);
        segments = segmentsOf(strands);
    }
    header.add(HairArray::points);
    setAttribute(header, HairArray::thickness, &HairHeader::default_thickness, strands.widths);
    setAttribute(
        header, HairArray::transparency, &HairHeader::default_transparency, strands.transparencies);
    setAttribute(header, HairArray::colors, &HairHeader::default_color, strands.colors);
    setInfo(header, strands.comment, warnings);

    writeValue(out, header);
    writeArray(out, segments);
    writeArray(out, strands.points);
    writeArray(out, strands.widths.values);
    writeArray(out, strands.transparencies.values);
    writeArray(out, strands.colors.values);
    return warnings;
}

StrandSet importHair(const StrandFile& file) {
    const HairHeader header = readHairHeader(file.bytes);
    const Layout layout(header);
    checkSize(header, layout, file.bytes.size());
    return {
        .ends = header.has(HairArray::segments) ? readEnds(header, layout.segments, file.bytes)
                                                : defaultEnds(header),
        .points = arrayAt<glm::vec3>(file.bytes, layout.points, header.point_count),
        .widths = readWidths(header, layout, file.bytes),
        .transparencies = readAttribute<float>(
            {HairArray::transparency, layout.transparency, header.default_transparency}, header,
            file.bytes),
        .colors = readAttribute<glm::vec3>(
            {HairArray::colors, layout.colors, header.default_color}, header, file.bytes),
        .comment = textOf(header.info)};
}

}  // namespace hair::groom
