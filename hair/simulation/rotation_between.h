#pragma once

#include <glm/ext/quaternion_double.hpp>
#include <glm/geometric.hpp>

#include "hair/simulation/perpendicular.h"

namespace hair {

// The smallest rotation from one unit vector to another; half a turn round perpendicular(from)
// where they are opposite. The same choice as in shaders/common/quaternion.glsl.
inline glm::dquat rotationBetween(const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 sum = from + to;
    if (glm::dot(sum, sum) < 1e-12) return {0.0, perpendicular(from)};
    const glm::dvec3 halfway = glm::normalize(sum);
    return {glm::dot(from, halfway), glm::cross(from, halfway)};
}

}  // namespace hair
