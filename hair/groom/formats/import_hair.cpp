#include "hair/groom/formats/import_hair.h"

#include <algorithm>
#include <string>
#include <utility>

#include "hair/groom/formats/binary_file.h"
#include "hair/groom/formats/hair_header.h"
#include "hair/groom/formats/uniform.h"

namespace hair {
namespace {

HairHeader readHeader(std::span<const std::byte> bytes) {
    if (bytes.size() < sizeof(HairHeader)) {
        failAt(
            bytes.size(),
            "truncated: the header alone is " + std::to_string(sizeof(HairHeader)) + " bytes");
    }
    const auto header = valueAt<HairHeader>(bytes, 0);
    const std::string arrays = "arrays " + std::to_string(header.arrays);
    if (header.magic != HairHeader{}.magic) failAt(0, "a .hair file begins with \"HAIR\"");
    if (header.hair_count == 0) failAt(4, "0 strands, at least 1 is needed");
    if ((header.arrays & ~kAllHairArrays) != 0)
        failAt(12, arrays + ": only the bits 0 to 4 are known");
    if (!header.has(HairArray::points))
        failAt(12, arrays + ": bit 1 is not set, so there are no points");
    return header;
}

// Where the arrays lie, those that are absent with size 0. The counts are less than 2^32, so that
// all of it fits in 64 bits.
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
                            ", there are " + std::to_string(header.point_count));
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

// An array's elements, or what the header says for all of them.
template <class Value>
struct Source {
    HairArray array;
    std::uint64_t start;  // of the array
    Value everywhere;
    std::uint64_t everywhere_at;  // in the header
    std::string name;             // of one, for messages
};

template <class Value>
PointAttribute<Value> readAttribute(
    const Source<Value>& source, const HairHeader& header, std::span<const std::byte> bytes) {
    PointAttribute<Value> attribute;
    if (header.has(source.array)) {
        attribute.values = arrayAt<Value>(bytes, source.start, header.point_count);
        requireFinite(attribute.values, source.start, source.name);
    } else {
        const std::span numbers(
            reinterpret_cast<const float*>(&source.everywhere), sizeof(Value) / sizeof(float));
        if (const auto wrong = firstNotFinite(numbers)) {
            failAt(
                source.everywhere_at + *wrong * sizeof(float),
                "the default " + source.name + " is not finite");
        }
        attribute.everywhere = source.everywhere;
    }
    return attribute;
}

PointAttribute<float>
readWidths(const HairHeader& header, const Layout& layout, std::span<const std::byte> bytes) {
    const Source<float> source{
        HairArray::thickness, layout.thickness, header.default_thickness,
        offsetof(HairHeader, default_thickness), "thickness"};
    auto widths = readAttribute(source, header, bytes);
    requireNotNegative(widths.values, source.start, source.name);
    if (widths.everywhere.value_or(0.0f) < 0.0f)
        failAt(source.everywhere_at, "the default thickness is negative");
    if (widths.everywhere == 0.0f) widths.everywhere.reset();
    return widths;
}

std::string textOf(const std::array<char, 88>& info) {
    return {info.begin(), std::ranges::find(info, '\0')};
}

}  // namespace

StrandSet importHair(const StrandFile& file) {
    const HairHeader header = readHeader(file.bytes);
    const Layout layout(header);
    checkSize(header, layout, file.bytes.size());
    StrandSet strands{
        .ends = header.has(HairArray::segments) ? readEnds(header, layout.segments, file.bytes)
                                                : defaultEnds(header),
        .points = arrayAt<glm::vec3>(file.bytes, layout.points, header.point_count),
        .widths = readWidths(header, layout, file.bytes),
        .transparencies = readAttribute<float>(
            {HairArray::transparency, layout.transparency, header.default_transparency,
             offsetof(HairHeader, default_transparency), "transparency"},
            header, file.bytes),
        .colors = readAttribute<glm::vec3>(
            {HairArray::colors, layout.colors, header.default_color,
             offsetof(HairHeader, default_color), "colour"},
            header, file.bytes),
        .comment = textOf(header.info)};
    requireFinite(strands.points, layout.points, "point");
    return strands;
}

}  // namespace hair
