#pragma once

#include <cstdint>

#include "hair/gpu_structs.h"
#include "hair/settings.h"

// The scalings that stiffness.h describes, from its text and not from its code: the step against
// 1/60 s, 10 iterations and segments of 0.15/7 m.
namespace hair::reference {

// gpu::Step in double.
struct Step {
    double whole = 0.0;  // s
    double sub = 0.0;    // s
    std::uint32_t count = 1;
};

inline Step inDouble(const gpu::Step& step) {
    return {.whole = step.whole, .sub = step.sub, .count = step.count};
}

// Fraction of the velocity left after a substep.
double keptFactor(const SimulationSettings& settings, const Step& step);
// k_G of thesis eq. 10 for a substep.
double globalFactor(const SimulationSettings& settings, const Step& step);
// k_L of thesis eq. 11 for an iteration on a strand with this mean segment length, m.
double localFactor(const SimulationSettings& settings, const Step& step, double segment_length);

}  // namespace hair::reference
