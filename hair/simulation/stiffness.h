#pragma once

#include "hair/gpu_structs.h"
#include "hair/settings.h"

// From the settings to the factors that a solver applies in a substep, which is the step dt here.
//
// StiffnessScaling::thesis applies the settings' numbers as they are, so a smaller step, more
// iterations or shorter segments make stiffer hair. StiffnessScaling::invariant reads them as the
// thesis's hair at the thesis's step, iterations and segment length, and keeps that hair when any
// of the three changes.
//
// Global: a pull by a fraction k per step is one implicit step of a spring, k = c / (1 + c) with
// c = (stiffness / mass) dt^2. So c = k / (1 - k) at the reference step is scaled by (dt / h0)^2.
// Under an acceleration a its equilibrium is off by a dt^2 (1 - k) / k = a dt^2 / c: the same at
// every step.
//
// Local: the torque at a joint of a beam is EI dtheta / l and moves a mass that is proportional to
// l at arm l, so the rate at which an error dies is proportional to dt^2 / l^4. n0 iterations leave
// (1 - k)^n0 of it; its power (dt / h0)^2 (l0 / l)^4 is what the n iterations of a step together
// leave. A strand's sag then depends on the step by a few percent even at k = 0.2; segments so
// short that the iterations can't carry a correction along the strand stay too soft.
//
// Friction leaves a fraction of the velocity per reference step, hence its power dt / h0 per step.
namespace hair {

inline constexpr double kReferenceStep = 1.0 / 60.0;  // h0, s
inline constexpr double kReferenceIterations = 10.0;  // n0
inline constexpr double kReferenceSegment = 0.15 / 7.0;  // l0, m
// Per iteration, as in the thesis's program.
inline constexpr double kGreatestLocalStiffness = 0.95;

// Fraction of the velocity left after a substep.
double velocityKept(const SimulationSettings& settings, const gpu::Step& step);

// k_G of thesis eq. 10 for one substep, in [0, 1].
double globalStiffness(const SimulationSettings& settings, const gpu::Step& step);

// k_L of thesis eq. 11 for one iteration, in [0, kGreatestLocalStiffness]. `segment_length` is the
// mean rest length of the strand's segments, m; a strand without length is as stiff as can be.
double
localStiffness(const SimulationSettings& settings, const gpu::Step& step, double segment_length);

}  // namespace hair
