#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hair/groom/growth/grid_point.h"

namespace hair {

// Cuts a polygon into its n - 2 triangles, counter-clockwise and never flat, whichever way the
// polygon runs. Vertices may lie on the line between their neighbours. O(n^2) as a rule.
// Meisters 1975, Polygons have ears.
// Throws engine::Error if the polygon has fewer than 3 vertices or touches or crosses itself.
std::vector<std::array<std::uint32_t, 3>> clipEars(std::span<const GridPoint> polygon);

}  // namespace hair
