#include "hair/groom/groom.h"

#include <algorithm>

#include "hair/groom/groom_size.h"

namespace hair::groom {

GroomSize sizeOf(const Groom& groom) {
    return {
        .guides = groom.strand_count,
        .vertices_per_guide = groom.vertices_per_strand,
        .root_triangles = groom.root_triangles.size(),
        .bound_strands = groom.bindings.size(),
        .bound_points = groom.bound_points.size()};
}

std::optional<std::uint32_t> commonSize(const StrandSet& strands) {
    if (strands.ends.empty()) return {};
    const std::uint32_t size = strands.ends.front();
    for (std::uint32_t i = 1; i < strands.strandCount(); ++i)
        if (strands.size(i) != size) return {};
    return size;
}

std::uint32_t greatestSize(const StrandSet& strands) {
    std::uint32_t greatest = 0;
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i)
        greatest = std::max(greatest, strands.size(i));
    return greatest;
}

}  // namespace hair::groom
