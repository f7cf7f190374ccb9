#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace hair {

// The published program's random pairs, which every root triangle has alike: [strand], in [0, 1),
// multiples of 2^-24. They are made here, for the sines of devices are too different to give the
// same hair: the formula takes the last bits of them.
std::vector<glm::vec2> thesisRootPattern(std::uint32_t density);

}  // namespace hair
