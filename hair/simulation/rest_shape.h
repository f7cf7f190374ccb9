#pragma once

#include <vector>

#include <glm/vec4.hpp>

#include "hair/groom/groom.h"

namespace hair {

// The rest shape as the local constraint (Han and Harada 2012) wants it: xyz is the rest edge that
// ends in the vertex, seen from the frame that parallel transport carries from segment 1 along the
// rest strand to the segment before that edge, m; w is the edge's length, m. With Q_i the smallest
// rotation from the tangent of segment i - 1 to that of segment i, edge i is turned by (Q_(i-1) ...
// Q_2)^-1. The frame of the moving strand, P_(i-1) ... P_1, then turns it into the goal. Zero at
// the root. [strand][vertex]
std::vector<glm::vec4> transportedRestEdges(const Groom& groom);

// Mean rest length of the segments of each strand, m. [strand]
std::vector<double> meanSegmentLengths(const Groom& groom);

}  // namespace hair
