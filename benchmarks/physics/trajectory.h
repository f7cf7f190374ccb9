#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "engine/device.h"
#include "hair/settings.h"

namespace benchmarks::physics {

inline constexpr double kTrajectoryLength = 0.15;  // m

// Points at eighths of the strand from the root, [sample][point], m.
using Trajectory = std::vector<std::vector<glm::dvec3>>;

// A strand let go from the horizontal: 2 s, sampled every 1/30 s. A time that is no whole number of
// steps is interpolated linearly between the steps around it. `segments` is a multiple of 8.
Trajectory playRelease(
    const engine::Device& device, const hair::SimulationSettings& settings, std::uint32_t segments);

// Greatest distance of a point at any time / strand length.
double differenceOf(const Trajectory& a, const Trajectory& b);

}  // namespace benchmarks::physics
