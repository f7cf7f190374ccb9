#include "hair/groom/growth/direction_field.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace hair {
namespace {

constexpr double kLeastRise = 0.05;  // of a direction along the normal

// Unit length, or zero where there is nothing along the surface.
glm::dvec3 alongSurface(const glm::dvec3& vector, const glm::dvec3& normal) {
    const glm::dvec3 flat = vector - glm::dot(vector, normal) * normal;
    const double length = glm::length(flat);
    return length > 1e-9 ? flat / length : glm::dvec3(0.0);
}

glm::dvec3
whorl(const WhorlSettings& settings, const glm::dvec3& from_centre, const glm::dvec3& normal) {
    const double r = glm::length(from_centre) / settings.radius;
    const double strength = settings.strength * r * std::exp(0.5 * (1.0 - r * r));
    return strength * alongSurface(glm::cross(normal, from_centre), normal);
}

glm::dvec3 partingAt(
    const PartingSettings& settings, const PartingLine::Place& place, const glm::dvec3& normal) {
    if (place.across == 0.0) return glm::dvec3(0.0);
    const double cosine = std::abs(place.across) / std::hypot(place.across, place.beyond);
    const double strength = settings.strength * cosine * std::exp(-place.distance / settings.reach);
    return strength * alongSurface(place.away, normal);
}

glm::dvec3 lifted(const glm::dvec3& direction, const glm::dvec3& normal) {
    if (glm::dot(direction, normal) >= kLeastRise) return direction;
    const glm::dvec3 flat = alongSurface(direction, normal);
    return glm::normalize(std::sqrt(1.0 - kLeastRise * kLeastRise) * flat + kLeastRise * normal);
}

}  // namespace

DirectionField::DirectionField(
    const GrowSettings& settings, const NearestSurface& surface, const PartingLine* parting)
    : settings_(settings), parting_(parting) {
    if (settings.whorl.strength != 0.0f)
        whorl_centre_ = surface(glm::dvec3(settings.whorl.position)).position;
}

glm::dvec3 DirectionField::operator()(const SurfacePoint& root) const {
    const glm::dvec3 normal(root.normal);
    const bool has_whorl = settings_.whorl.strength != 0.0f;
    glm::dvec3 direction = normal + glm::dvec3(settings_.comb);
    if (has_whorl)
        direction += whorl(settings_.whorl, glm::dvec3(root.position) - whorl_centre_, normal);
    if (parting_)
        direction +=
            partingAt(settings_.parting, parting_->place(glm::dvec3(root.position)), normal);
    const double length = glm::length(direction);
    direction = length > 1e-6 ? direction / length : glm::normalize(normal);
    return has_whorl || parting_ ? lifted(direction, normal) : direction;
}

}  // namespace hair
