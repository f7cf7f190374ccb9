#include "benchmarks/mitsuba_optics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace benchmarks {

glm::dvec3 toLinear(const glm::dvec3& display) {
    glm::dvec3 linear;
    for (int i = 0; i < 3; ++i) {
        linear[i] = display[i] <= 0.04045 ? display[i] / 12.92
                                          : std::pow((display[i] + 0.055) / 1.055, 2.4);
    }
    return linear;
}

glm::dvec3 absorptionOf(const glm::dvec3& color, double azimuthal_roughness) {
    const double b = azimuthal_roughness;
    const double scale =
        5.969 + b * (-0.215 + b * (2.532 + b * (-10.73 + b * (5.574 + b * 0.245))));
    glm::dvec3 absorption;
    for (int i = 0; i < 3; ++i) {
        const double root = std::log(std::clamp(color[i], 1e-4, 1.0)) / scale;
        absorption[i] = root * root;
    }
    return absorption;
}

glm::dvec3 lightIntensity(const hair::LightSettings& light, const glm::dvec3& target) {
    const glm::dvec3 offset = glm::dvec3(light.position) - target;
    // A matt white surface reflects irradiance / pi; irradiance is intensity / distance^2.
    return std::numbers::pi * glm::dot(offset, offset) * toLinear(light.color);
}

}  // namespace benchmarks
