#include "hair/simulation/reference_factors.h"

#include <algorithm>
#include <cmath>

namespace hair::reference {

double keptFactor(const SimulationSettings& settings, const Step& step) {
    const double kept = 1.0 - double{settings.friction};
    if (settings.stiffness_scaling == StiffnessScaling::thesis) return kept;
    return std::pow(kept, step.sub * 60.0);
}

double globalFactor(const SimulationSettings& settings, const Step& step) {
    const double k = settings.global.stiffness;
    if (settings.stiffness_scaling == StiffnessScaling::thesis || k == 1.0) return k;
    const double steps = step.sub * 60.0;
    const double c = k / (1.0 - k) * steps * steps;
    return c / (1.0 + c);
}

double localFactor(const SimulationSettings& settings, const Step& step, double segment_length) {
    const double k = std::min(double{settings.local.stiffness}, 0.95);
    if (settings.stiffness_scaling == StiffnessScaling::thesis || k == 0.0) return k;
    if (segment_length == 0.0) return 0.95;
    const double steps = step.sub * 60.0;
    const double left = std::pow(1.0 - k, 10.0);  // of an error after a reference step
    const double left_by_step =
        std::pow(left, steps * steps * std::pow(0.15 / 7.0 / segment_length, 4.0));
    return std::min(1.0 - std::pow(left_by_step, 1.0 / settings.local.iterations), 0.95);
}

}  // namespace hair::reference
