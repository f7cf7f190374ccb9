#include "benchmarks/physics/oscillation.h"

#include <cstddef>

namespace benchmarks::physics {

std::optional<double> frequencyOf(std::span<const double> samples, double interval) {
    double first = 0.0;
    double last = 0.0;
    int crossings = 0;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const double a = samples[i - 1];
        const double b = samples[i];
        if ((a < 0.0) == (b < 0.0)) continue;
        last = static_cast<double>(i - 1) + a / (a - b);
        if (crossings++ == 0) first = last;
    }
    if (crossings < 3) return {};
    return (crossings - 1) / (2.0 * interval * (last - first));
}

}  // namespace benchmarks::physics
