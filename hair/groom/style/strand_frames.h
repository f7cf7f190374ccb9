#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace hair {

// Unit vectors at a point of a strand: along it, across it, and the cross product of the two.
struct StrandFrame {
    glm::dvec3 tangent;
    glm::dvec3 normal;
    glm::dvec3 binormal;
};

// The direction of the first segment that has a length; (0, 0, 1) on a strand without length.
glm::dvec3 rootDirection(std::span<const glm::vec3> points);

// A unit vector across a unit vector, always the same one.
glm::dvec3 across(const glm::dvec3& direction);

// Frames that don't turn about the strand, one at each point. The first one's normal is in the
// plane of the strand's direction at the root and `root_normal`; where the two are parallel (less
// than 0.001 rad) or `root_normal` is null, towards the point that is furthest from the line of
// that direction; on a straight strand, across().
// Wang, Jüttler, Zheng and Liu 2008, Computation of rotation minimizing frames, table I (double
// reflection).
std::vector<StrandFrame>
strandFrames(std::span<const glm::vec3> points, const glm::vec3* root_normal);

}  // namespace hair
