#pragma once

#include <algorithm>
#include <cstdint>

#include <glm/ext/quaternion_double.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "engine/commands.h"
#include "hair/gpu_structs.h"
#include "hair/settings.h"

// What the solvers have in common: rotations, and stiffness at any step.
namespace hair::simulation {

// A unit vector perpendicular to `v`: its cross product with the axis it has least of (x before y
// before z where they tie). (0, 1, 0) for v = 0. The same choice as in
// shaders/common/quaternion.glsl.
inline glm::dvec3 perpendicular(const glm::dvec3& v) {
    const glm::dvec3 size = glm::abs(v);
    glm::dvec3 axis{0.0, 0.0, 1.0};
    if (size.x <= size.y && size.x <= size.z)
        axis = {1.0, 0.0, 0.0};
    else if (size.y <= size.z)
        axis = {0.0, 1.0, 0.0};
    const glm::dvec3 normal = glm::cross(v, axis);
    const double length = glm::length(normal);
    return length > 0.0 ? normal / length : glm::dvec3{0.0, 1.0, 0.0};
}

// The smallest rotation from one unit vector to another; half a turn round perpendicular(from)
// where they are opposite. The same choice as in shaders/common/quaternion.glsl.
inline glm::dquat rotationBetween(const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 sum = from + to;
    if (glm::dot(sum, sum) < 1e-12) return {0.0, perpendicular(from)};
    const glm::dvec3 halfway = glm::normalize(sum);
    return {glm::dot(from, halfway), glm::cross(from, halfway)};
}

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
// Local with an energy: shaders/simulation/constraints/bend.glsl. The thesis's pull holds a segment
// by n0 k_L / 2 of its distance from its goal in a reference step, where pulls are small, so that
// its stiffness is K = -n0 ln(1 - k_L) / (2 h0^2), twice that at the root, and a segment with n
// vertices below it turns by n g / (K l0). One that turns the segment above back bears a moment
// instead, and turns by n (n + 1) g / (2 K l0). With 4 times the stiffness, the sum of
// n^2 (n + 1) / 2 over that of n^2, half of it at the root, for 7 segments, the tip of the thesis's
// level hair sags as much. A beam's joint has EI / l = m l^2 K with a mass m proportional to l, so
// K is proportional to 1 / l^4.
//
// Friction leaves a fraction of the velocity per reference step, hence its power dt / h0 per step.

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

// substep^2 times the stiffness over a vertex's mass of the local constraint with an energy,
// [0, infinity). `segment_length` as above.
double
bendStiffness(const SimulationSettings& settings, const gpu::Step& step, double segment_length);

// How many times that is the energy's implicit stiffness: its damping is that of an implicit
// reference step, however short a substep is.
double bendDamping(const gpu::Step& step);

// Gravity at the start as the groom sees it on its head, m/s^2.
glm::dvec3 gravityOnGroom(const SimulationSettings& settings);

}  // namespace hair::simulation
