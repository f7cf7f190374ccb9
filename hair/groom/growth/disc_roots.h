#pragma once

#include "hair/groom/growth/roots.h"

namespace hair {

// How many of `guides` roots lie on the hairline. The thesis's 86 guides with 136 root triangles
// have 34 there (Euler: 2 * 86 - 2 - 34 = 136); the ratio of edge to area keeps it proportional to
// the square root.
std::uint32_t boundaryRootCount(std::uint32_t guides);

// Lengths along a hairline of `total` m at which `count` roots are evenly spaced, the first at 0;
// or with up to two cuts from `gap` after one to `gap` before the next, both with a root.
std::vector<double>
hairlineLengths(double total, std::uint32_t count, std::vector<double> cuts, double gap);

// Puts `guides` >= 3 roots on a scalp that is a disc, some evenly along the hairline, the rest
// spread over the inside, and spans them by triangles that are Delaunay on the sphere of
// directions. Throws engine::Error if the scalp is no disc or can't be flattened.
Roots discRoots(const Scalp& scalp, const RootOptions& options, const PartingRows* rows);

}  // namespace hair
