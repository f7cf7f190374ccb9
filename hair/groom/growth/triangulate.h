#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "hair/groom/growth/scalp.h"
#include "hair/groom/growth/spread.h"

namespace hair::groom {

// The scalp's triangles, those with roots cut into ones that have the roots as corners. Vertices
// are numbered: the roots, then the scalp's.
std::vector<std::array<std::uint32_t, 3>>
cutAtRoots(const Scalp& scalp, std::span<const SurfacePoint> roots);

// Cuts a polygon into its n - 2 triangles, counter-clockwise and never flat, whichever way the
// polygon runs. Vertices may lie on the line between their neighbours. O(n^2) as a rule.
// Meisters 1975, Polygons have ears.
// Throws engine::Error if the polygon has fewer than 3 vertices or touches or crosses itself.
std::vector<std::array<std::uint32_t, 3>> clipEars(std::span<const GridPoint> polygon);

// The triangles between roots that lie on a scalp of any shape: it is cut at the roots, its own
// vertices are taken out one by one, and edges are flipped until angles opposite an edge have a sum
// of at most 180 degrees, as in a Delaunay triangulation. Each triangle is counter-clockwise seen
// from outside, an edge has at most two, which run along it in opposite directions, and none joins
// pieces of the scalp that have no edge in common. Along a boundary roots are joined where the
// triangle is not much longer than high; no triangle reaches over a hole. A piece with one root has
// the triangle {a, a, a}; one whose roots span none has {a, b, b} from each to the next.
std::vector<std::array<std::uint32_t, 3>>
surfaceTriangles(const Scalp& scalp, std::span<const SurfacePoint> roots);

// The constrained Delaunay triangulation of a polygon with points inside it. The first
// `boundary_count` points are the polygon's vertices in order, either way round; the others lie
// strictly inside. All points are used, and the triangles, counter-clockwise index triples, cover
// exactly the polygon: 2 N - 2 - h of them for N points, h of them on the boundary. Coordinates are
// rounded to 2^-29 of the extent, and on these all decisions are exact. Cocircular points are fine.
// Throws engine::Error for a coordinate that isn't finite, points that coincide, a boundary that
// meets itself, or a point that isn't inside.
std::vector<std::array<std::uint32_t, 3>>
triangulate(std::span<const glm::dvec2> points, std::uint32_t boundary_count);

}  // namespace hair::groom
