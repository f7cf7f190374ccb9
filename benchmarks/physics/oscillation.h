#pragma once

#include <optional>
#include <span>

namespace benchmarks::physics {

// Frequency of what swings about 0, from the times between its first and last zero crossing, which
// damping does not move; Hz. Samples are `interval` s apart. Absent with fewer than three
// crossings.
std::optional<double> frequencyOf(std::span<const double> samples, double interval);

}  // namespace benchmarks::physics
