#pragma once

#include <cmath>

namespace benchmarks::physics {

// The greater of two errors; what is not a number is the greatest of all, and stays.
inline double worst(double a, double b) { return std::isnan(a) || b <= a ? a : b; }

}  // namespace benchmarks::physics
