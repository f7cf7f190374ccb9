#pragma once

#include <cstdint>
#include <vector>

#include "hair/groom/groom.h"

namespace hair::groom {

// Picks `count` strands of a dense groom to be its guides, spread over roots and shapes: strands
// that are far apart, or next to each other but unlike, both get guides. Returns indices in
// ascending order. No two have the same root and shape, and none is without length, while others
// are left. The same arguments give the same guides. Throws engine::Error if the groom has fewer
// strands.
std::vector<std::uint32_t>
chooseGuides(const Groom& dense, std::uint32_t count, std::uint32_t seed);

// Returns the groom of these strands alone, with their normals and widths, without triangles and
// bindings.
Groom pickStrands(const Groom& dense, const std::vector<std::uint32_t>& strands);

}  // namespace hair::groom
