#pragma once

#include "hair/settings.h"

// From the settings to the factors that a step applies.
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
// l at arm l, so its c is proportional to dt^2 / l^4. n iterations at factor k leave (1 - k)^n of
// an error, so c and the factor of n iterations together are related as above, and each applies 1 -
// (1 - total)^(1 / n). The pull of one joint is then invariant; the sag of a whole strand, which
// many joints share, is so for small k only.
//
// Friction leaves a fraction of the velocity per reference step, hence its power dt / h0 per step.
namespace hair {

inline constexpr double kReferenceStep = 1.0 / 60.0;     // h0, s
inline constexpr double kReferenceIterations = 10.0;     // n0
inline constexpr double kReferenceSegment = 0.15 / 7.0;  // l0, m
// Per iteration, as in the thesis's program.
inline constexpr double kGreatestLocalStiffness = 0.95;

// Fraction of the velocity left after a step.
double velocityKept(const SimulationSettings& settings);

// k_G of thesis eq. 10 for one step, in [0, 1].
double globalStiffness(const SimulationSettings& settings);

// k_L of thesis eq. 11 for one iteration, in [0, kGreatestLocalStiffness]. `segment_length` is the
// mean rest length of the strand's segments, m; a strand without length is as stiff as can be.
double localStiffness(const SimulationSettings& settings, double segment_length);

}  // namespace hair
