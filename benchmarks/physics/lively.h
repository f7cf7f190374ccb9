#pragma once

#include "benchmarks/physics/experiment.h"

namespace benchmarks::physics {

inline constexpr double kLivelyLength = 0.15;  // m, the thesis's

// Default hair in strong wind on a head that shakes once and nods, for 2 s.
hair::SimulationSettings livelyHair(hair::Solver solver);

// Sixteen hanging strands of the thesis's 8 vertices, 1 cm apart.
hair::Groom livelyGroom();

}  // namespace benchmarks::physics
