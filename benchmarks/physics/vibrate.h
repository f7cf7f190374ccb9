#pragma once

#include <optional>
#include <span>

#include "benchmarks/physics/experiment.h"

namespace benchmarks::physics {

// Releases a strand that is deflected along `sideways` (deflection.h) and measures the frequency
// with which it swings through five of the periods that theory expects. Absent if it does not
// swing.
struct Vibration {
    std::span<const double> shape;  // [vertex], root first
    double segment;                 // m
    glm::dvec3 direction;
    glm::dvec3 sideways;
    double expected_frequency;  // Hz
};
std::optional<double> measureFrequency(Experiment& experiment, const Vibration& vibration);

}  // namespace benchmarks::physics
