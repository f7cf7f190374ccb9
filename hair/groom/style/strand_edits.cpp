#include "hair/groom/style/strand_edits.h"

#include <limits>
#include <string>

#include "engine/error.h"

namespace hair {
namespace {

template <class Value>
std::vector<Value> pickPoints(
    const std::vector<Value>& values, const StrandSet& strands,
    std::span<const std::uint32_t> indices, std::size_t count) {
    std::vector<Value> picked;
    if (values.empty()) return picked;
    picked.reserve(count);
    for (const std::uint32_t strand : indices) {
        const auto first = values.begin() + std::ptrdiff_t{strands.first(strand)};
        picked.insert(picked.end(), first, first + std::ptrdiff_t{strands.size(strand)});
    }
    return picked;
}

}  // namespace

StrandSet pickStrands(const StrandSet& strands, std::span<const std::uint32_t> indices) {
    StrandSet picked{
        .metres_per_unit = strands.metres_per_unit,
        .comment = strands.comment,
        .warnings = strands.warnings};
    std::size_t count = 0;
    picked.ends.reserve(indices.size());
    for (const std::uint32_t strand : indices) {
        count += strands.size(strand);
        picked.ends.push_back(static_cast<std::uint32_t>(count));
    }
    if (count > std::numeric_limits<std::uint32_t>::max())
        throw engine::Error(
            std::to_string(indices.size()) + " strands have " + std::to_string(count) +
            " points, more than 2^32 - 1");
    const auto pick = [&](const auto& values) {
        return pickPoints(values, strands, indices, count);
    };
    picked.points = pick(strands.points);
    picked.widths = {strands.widths.everywhere, pick(strands.widths.values)};
    picked.transparencies = {
        strands.transparencies.everywhere, pick(strands.transparencies.values)};
    picked.colors = {strands.colors.everywhere, pick(strands.colors.values)};
    if (!strands.root_uvs.empty()) {
        picked.root_uvs.reserve(indices.size());
        for (const std::uint32_t strand : indices)
            picked.root_uvs.push_back(strands.root_uvs[strand]);
    }
    return picked;
}

StrandSet scaleLengths(StrandSet strands, double factor) {
    const auto scale = [factor](float& length) { length = static_cast<float>(length * factor); };
    for (glm::vec3& point : strands.points) point = glm::vec3(glm::dvec3(point) * factor);
    for (float& width : strands.widths.values) scale(width);
    if (strands.widths.everywhere) scale(*strands.widths.everywhere);
    return strands;
}

}  // namespace hair
