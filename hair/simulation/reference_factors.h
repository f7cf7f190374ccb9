#pragma once

#include "hair/settings.h"

// The scalings that stiffness.h describes, from its text and not from its code: the step against
// 1/60 s, 10 iterations and segments of 0.15/7 m. `settings.time_step` is a substep.
namespace hair::reference {

// Fraction of the velocity left after a substep.
double keptFactor(const SimulationSettings& settings);
// k_G of thesis eq. 10 for a substep.
double globalFactor(const SimulationSettings& settings);
// k_L of thesis eq. 11 for an iteration on a strand with this mean segment length, m.
double localFactor(const SimulationSettings& settings, double segment_length);

}  // namespace hair::reference
