#include "hair/groom/formats/export_hair.h"

#include <algorithm>
#include <limits>

#include "hair/groom/formats/binary_file.h"
#include "hair/groom/formats/hair_header.h"
#include "hair/groom/formats/left_out.h"

namespace hair {
namespace {

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

// Puts what holds everywhere into the header, or says there that each point has a value.
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

}  // namespace hair
