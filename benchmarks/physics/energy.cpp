#include "benchmarks/physics/energy.h"

#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "benchmarks/physics/solver_settings.h"

namespace benchmarks::physics {

namespace {

// The clamp's joint is half a segment long: the other half would be in the skin.
double bendingEnergy(
    std::span<const glm::dvec3> points, double stiffness, double segment,
    const glm::dvec3& clamp_tangent) {
    double energy = 0.0;
    glm::dvec3 before = clamp_tangent;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const glm::dvec3 tangent = glm::normalize(points[i] - points[i - 1]);
        const double angle =
            std::atan2(glm::length(glm::cross(before, tangent)), glm::dot(before, tangent));
        energy += 0.5 * stiffness * angle * angle / (i == 1 ? segment / 2.0 : segment);
        before = tangent;
    }
    return energy;
}

}  // namespace

double energyOf(
    std::span<const glm::dvec3> before, std::span<const glm::dvec3> after,
    const hair::SimulationSettings& settings, double length) {
    const std::size_t count = after.size();
    const double segment = length / static_cast<double>(count - 1);
    const bool rod = !lack(settings.solver, Need::material);
    std::vector<glm::dvec3> points{after[0]};
    double energy = 0.0;
    for (std::size_t i = 1; i < count; ++i) {
        points.push_back(0.5 * (before[i] + after[i]));
        const glm::dvec3 velocity = (after[i] - before[i]) / double{settings.time_step};
        const bool half = rod && i + 1 == count;  // only one segment ends at a rod's tip
        const double mass = lineDensity(settings.material) * segment * (half ? 0.5 : 1.0);
        energy += mass * (0.5 * glm::dot(velocity, velocity) + kGravity * points[i].y);
    }
    if (rod)
        energy +=
            bendingEnergy(points, bendingStiffness(settings.material), segment, {1.0, 0.0, 0.0});
    return energy;
}

}  // namespace benchmarks::physics
