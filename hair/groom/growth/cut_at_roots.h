#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hair/groom/growth/scalp.h"

namespace hair {

// The scalp's triangles, those with roots cut into ones that have the roots as corners. Vertices
// are numbered: the roots, then the scalp's.
std::vector<std::array<std::uint32_t, 3>>
cutAtRoots(const Scalp& scalp, std::span<const SurfacePoint> roots);

}  // namespace hair
