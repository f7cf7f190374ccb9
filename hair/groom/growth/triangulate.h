#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace hair {

// The constrained Delaunay triangulation of a polygon with points inside it. The first
// `boundary_count` points are the polygon's vertices in order, either way round; the others lie
// strictly inside. All points are used, and the triangles, counter-clockwise index triples, cover
// exactly the polygon: 2 N - 2 - h of them for N points, h of them on the boundary. Coordinates are
// rounded to 2^-29 of the extent, and on these all decisions are exact. Cocircular points are fine.
// Throws engine::Error for a coordinate that isn't finite, points that coincide, a boundary that
// meets itself, or a point that isn't inside.
std::vector<std::array<std::uint32_t, 3>>
triangulate(std::span<const glm::dvec2> points, std::uint32_t boundary_count);

}  // namespace hair
