#include "benchmarks/mitsuba_optics.h"

#include <numbers>

#include <glm/geometric.hpp>

#include "hair/rendering/working_color.h"

namespace benchmarks {
namespace {

// Squared distance at which the light has its colour, m^2.
double referenceSquared(const hair::LightSettings& light, const glm::dvec3& target) {
    const double reference{light.reference_distance};
    if (reference > 0.0) return reference * reference;
    const glm::dvec3 offset = glm::dvec3(light.position) - target;
    return glm::dot(offset, offset);
}

}  // namespace

glm::dvec3 lightColor(const hair::RenderSettings& render, const hair::LightSettings& light) {
    const double strength{light.strength};
    const glm::dvec3 color(light.color);
    // The strength is a factor of working colours.
    return hair::hasLinearLight(render) ? strength * hair::toLinear(color)
                                        : hair::toLinear(strength * color);
}

// A matt white surface reflects irradiance / pi; irradiance is intensity / distance^2.
glm::dvec3 lightIntensity(
    const hair::LightSettings& light, const glm::dvec3& color, const glm::dvec3& target) {
    return std::numbers::pi * referenceSquared(light, target) * color;
}

// The irradiance of a surface that faces a sphere is pi radiance (radius / distance)^2.
glm::dvec3
lightRadiance(const hair::LightSettings& light, const glm::dvec3& color, const glm::dvec3& target) {
    const double radius{light.radius};
    return referenceSquared(light, target) / (radius * radius) * color;
}

}  // namespace benchmarks
