#pragma once

#include <array>

#include <glm/vec3.hpp>

#include "hair/settings.h"

namespace hair {

// Four unit vectors at `cone_angle` from the wind's direction d, 90 degrees apart round it: toward
// u, v, -u and -v, where u = perpendicular(d) and v = d x u. A direction without length throws
// Error.
std::array<glm::dvec3, 4> windCone(const WindSettings& settings);

// Thesis eq. 13 with simulated time instead of the frame's number: sin^2(gust_rate time) + 0.5.
double windMagnitude(const WindSettings& settings, double time);

}  // namespace hair
