#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace benchmarks::physics {

// The greatest slope of a strand in a small vibration: 0.03^2 / 16 is its effect on a pendulum's
// frequency, 6e-5.
inline constexpr double kSmallSlope = 0.03;

// A strand from the origin along `direction` whose vertices are displaced along `sideways` in
// proportion to `shape` (root first), so that its steepest segment has kSmallSlope; segments keep
// their length. Both vectors are unit vectors, perpendicular. m
std::vector<glm::dvec3> deflected(
    std::span<const double> shape, double segment, const glm::dvec3& direction,
    const glm::dvec3& sideways);

// Sum of displacement along `sideways` times shape: how much of the shape there is, at any scale.
double amountOf(
    std::span<const double> shape, std::span<const glm::dvec3> positions,
    const glm::dvec3& sideways);

}  // namespace benchmarks::physics
