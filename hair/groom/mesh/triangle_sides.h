#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace hair {

using Triangle = std::array<std::uint32_t, 3>;

// One side of a triangle: from this corner to the next.
struct Side {
    std::uint32_t triangle;
    std::uint32_t corner;
};

// The two sides that run along each edge in opposite directions. Throws engine::Error that says how
// many edges are shared otherwise and where the first of them is.
std::vector<std::array<Side, 2>>
pairSides(std::span<const Triangle> triangles, std::span<const glm::vec3> positions);

// Leaves out triangles with equal corners, and turns the longest edge of those whose corners lie on
// a line: the same surface and still closed, without triangles that have no normal. Throws as
// pairSides does.
void removeFlatTriangles(std::vector<Triangle>& triangles, std::span<const glm::vec3> positions);

}  // namespace hair
