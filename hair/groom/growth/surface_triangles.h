#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hair/groom/growth/scalp.h"

namespace hair {

// The triangles between roots that lie on a scalp of any shape: it is cut at the roots, its own
// vertices are taken out one by one, and edges are flipped until angles opposite an edge have a sum
// of at most 180 degrees, as in a Delaunay triangulation. Each triangle is counter-clockwise seen
// from outside, an edge has at most two, which run along it in opposite directions, and none joins
// pieces of the scalp that have no edge in common. Along a boundary roots are joined where the
// triangle is not much longer than high; no triangle reaches over a hole. A piece with one root has
// the triangle {a, a, a}; one whose roots span none has {a, b, b} from each to the next.
std::vector<std::array<std::uint32_t, 3>>
surfaceTriangles(const Scalp& scalp, std::span<const SurfacePoint> roots);

}  // namespace hair
