#include "hair/simulation/wind.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "engine/error.h"
#include "hair/simulation/perpendicular.h"

namespace hair {

glm::dvec3 windDirection(const WindSettings& settings) {
    const glm::dvec3 direction = settings.direction;
    if (glm::length(direction) < 1e-6)
        throw engine::Error("/simulation/wind/direction", "has no length");
    return glm::normalize(direction);
}

std::array<glm::dvec3, 4> windCone(const WindSettings& settings) {
    const glm::dvec3 direction = windDirection(settings);
    const glm::dvec3 u = perpendicular(direction);
    const glm::dvec3 v = glm::cross(direction, u);

    const double angle = glm::radians(double{settings.cone_angle});
    const glm::dvec3 along = std::cos(angle) * direction;
    const double aside = std::sin(angle);
    return {along + aside * u, along + aside * v, along - aside * u, along - aside * v};
}

double windMagnitude(const WindSettings& settings, double time) {
    const double wave = std::sin(double{settings.gust_rate} * time);
    return wave * wave + 0.5;
}

// The density is in front of the power and not in the quotient: it may be 0.
DragFactors dragFactors(const WindSettings& settings, const MaterialSettings& material) {
    const double line = std::numbers::pi * double{material.radius} * double{material.density};
    const double layer = double{settings.air_viscosity} / (2.0 * double{material.radius});
    return {
        .inertial = double{settings.air_density} / line,
        .viscous = 10.0 * std::cbrt(double{settings.air_density} * layer * layer) / line};
}

}  // namespace hair
