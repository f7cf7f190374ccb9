#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/groom.h"
#include "hair/groom/strand_set.h"
#include "hair/rendering/strand_points.h"

namespace benchmarks {

// What a simulation leaves, as strands for a file; lengths in m.

// Strands as they are drawn: joints of segments once, without what is not drawn.
hair::StrandSet drawnStrands(const hair::StrandPoints& points);

// The guides, at `positions`, [guide][vertex].
hair::StrandSet guideStrands(const hair::Groom& groom, std::vector<glm::vec3> positions);

}  // namespace benchmarks
