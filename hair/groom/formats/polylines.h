#pragma once

#include <cstdint>
#include <vector>

#include "hair/groom/strand_set.h"

namespace hair {

// Strands as numbers of vertices.
struct Polylines {
    std::vector<std::uint32_t> ends;      // [strand], index after its last point
    std::vector<std::uint32_t> vertices;  // [point], strand after strand, root first
};

// Whether one more polyline of `size` points still has an end in 32 bits.
bool hasRoomFor(const Polylines& lines, std::size_t size);

// Strands of the vertices that `set` holds as points, with all that it holds for each: they become
// the points of `lines`, and vertices that no strand uses are left out with a warning. Every
// vertex of `lines` is there.
void arrangePoints(StrandSet& set, Polylines lines);

}  // namespace hair
