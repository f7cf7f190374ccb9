#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/strand_set.h"

namespace hair {

// The strands of a model that offsets can be taken from, at most `most` and spread over the file:
// those with a length. Throws engine::Error where there is none.
StrandSet offsetModel(const StrandSet& strands, std::uint32_t most);

// Adds the offsets of a strand of a model from its smooth shape, enlarged from that one's length to
// `length` and turned about it by `turn` (1: all the way round), to `samples`, evenly spaced from
// root to tip. The smooth shape is the cubic through the root that fits the strand best by arc
// length; the offsets are in its frame that does not turn about it.
void addModelOffsets(
    std::span<const glm::vec3> strand, double length, double turn, std::span<glm::vec3> samples);

}  // namespace hair
