#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace hair {

// Leaves out the triangles that reach over places where no roots are: those with an edge of more
// than three times the spacing round their corners, and slivers that are lower than 1 % of their
// length, which hulls of rows of roots have. The spacing at a root is the median of its edges and
// then of those medians among its neighbours, the lower one of two: on the edge of a face or a
// parting a root has no more edges across it than others, two of them along it (a polygon's corners
// have less than two diagonals each), and its neighbours inland have none.
// Evenly spread roots have no edge of more than 2 spacings between them, random ones about one
// triangle in a thousand with an edge of more than 3. If none is left, all are kept.
std::vector<std::array<std::uint32_t, 3>> withoutLongTriangles(
    std::vector<std::array<std::uint32_t, 3>> triangles, std::span<const glm::vec3> roots);

}  // namespace hair
