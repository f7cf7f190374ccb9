#pragma once

#include <span>

#include <glm/vec3.hpp>

#include "hair/settings.h"

namespace benchmarks::physics {

// Kinetic energy, weight's and, for a solver with a material, that of bending, of a strand that is
// straight along +x at rest, in the middle of a substep that began and ended so, J. Segments' spin
// is left out: it is of the order of (segment / length)^2.
double energyOf(
    std::span<const glm::dvec3> before, std::span<const glm::dvec3> after,
    const hair::SimulationSettings& settings, double length);

}  // namespace benchmarks::physics
