#pragma once

#include <array>

#include <glm/vec3.hpp>

#include "hair/settings.h"

namespace hair {

// Unit vector. A direction without length throws Error.
glm::dvec3 windDirection(const WindSettings& settings);

// Four unit vectors at `cone_angle` from the wind's direction d, 90 degrees apart round it: toward
// u, v, -u and -v, where u = perpendicular(d) and v = d x u. A direction without length throws
// Error.
std::array<glm::dvec3, 4> windCone(const WindSettings& settings);

// Thesis eq. 13 with simulated time instead of the frame's number: sin^2(gust_rate time) + 0.5.
double windMagnitude(const WindSettings& settings, double time);

// Air with the velocity u across a hair accelerates it by (inertial |u| + viscous |u|^(1/3)) u.
struct DragFactors {
    double inertial;  // rho_air / (pi r rho), 1/m
    double viscous;   // 10 (mu / (rho_air 2 r))^(2/3) of that, m^(-1/3) s^(-2/3)
};
DragFactors dragFactors(const WindSettings& settings, const MaterialSettings& material);

}  // namespace hair
