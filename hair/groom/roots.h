#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hair/groom/scalp.h"

namespace hair {

struct Roots {
    std::vector<SurfacePoint> points;  // the hairline's first, in its order
    std::uint32_t boundary_count = 0;
    std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise seen from outside
};

// How many of `guides` roots lie on the hairline. The thesis's 86 guides with 136 root triangles
// have 34 there (Euler: 2 * 86 - 2 - 34 = 136); the ratio of edge to area keeps it proportional to
// the square root.
std::uint32_t boundaryRootCount(std::uint32_t guides);

// Puts `guides` >= 3 roots on the scalp, some evenly along the hairline, the rest spread over the
// inside, and spans them by triangles that are Delaunay on the sphere of directions. Throws
// engine::Error if the scalp can't be flattened.
Roots placeRoots(const Scalp& scalp, std::uint32_t guides, std::uint32_t seed);

}  // namespace hair
