#include "hair/simulation/wind.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "engine/error.h"
#include "hair/simulation/perpendicular.h"

namespace hair {

std::array<glm::dvec3, 4> windCone(const WindSettings& settings) {
    glm::dvec3 direction = settings.direction;
    if (glm::length(direction) < 1e-6)
        throw engine::Error("/simulation/wind/direction", "has no length");
    direction = glm::normalize(direction);

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

}  // namespace hair
