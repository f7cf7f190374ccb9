#pragma once

#include <algorithm>
#include <cstdint>

#include <glm/ext/quaternion_double.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "engine/commands.h"
#include "hair/gpu_structs.h"
#include "hair/settings.h"

// Shared by the solvers: rotations, and stiffness at any step.
namespace hair::simulation {

// Returns a unit vector perpendicular to `v`: its cross product with the axis of its smallest
// component (in ties x before y before z). (0, 1, 0) for v = 0. shaders/common/quaternion.glsl
// makes the same choice.
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

// Returns the smallest rotation from one unit vector to another; half a turn round
// perpendicular(from) if they are opposite. shaders/common/quaternion.glsl makes the same choice.
inline glm::dquat rotationBetween(const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 sum = from + to;
    if (glm::dot(sum, sum) < 1e-12) return {0.0, perpendicular(from)};
    const glm::dvec3 halfway = glm::normalize(sum);
    return {glm::dot(from, halfway), glm::cross(from, halfway)};
}

// Converts the settings to the factors of a solver's substep. Below, dt is the substep.
//
// StiffnessScaling::thesis uses the settings unchanged, so a smaller step, more iterations or
// shorter segments make stiffer hair. StiffnessScaling::invariant takes them for the thesis's hair
// at the thesis's step, iterations and segment length, and keeps this hair's stiffness if any of
// the three changes.
//
// Global: a pull by a fraction k per step is one implicit step of a spring, k = c / (1 + c) with
// c = (stiffness / mass) dt^2. So c = k / (1 - k) at the reference step is scaled by (dt / h0)^2.
// Under an acceleration a, its equilibrium is off by a dt^2 (1 - k) / k = a dt^2 / c: the same at
// every step.
//
// Local: the torque at a joint of a beam is EI dtheta / l. It moves a mass proportional to l at the
// arm l, so errors decay at a rate proportional to dt^2 / l^4. n0 iterations leave the fraction
// (1 - k)^n0 of an error; the n iterations of a step together leave this fraction to the power of
// (dt / h0)^2 (l0 / l)^4. A strand's sag then depends on the step by a few percent even at k = 0.2.
// If segments are so short that the iterations can't carry a correction along the strand, they stay
// too soft.
//
// Local with an energy: shaders/simulation/constraints/bend.glsl. In a reference step the thesis's
// pull holds a segment by n0 k_L / 2 of its distance from its goal, if pulls are small. Its
// stiffness is therefore K = -n0 ln(1 - k_L) / (2 h0^2), twice that at the root, and a segment with
// n vertices below it turns by n g / (K l0). A segment that also turns the segment above back bears
// a moment instead, and turns by n (n + 1) g / (2 K l0). With 4 times the stiffness, the tip of the
// thesis's level hair sags as much: for 7 segments, 4 is the sum of n^2 (n + 1) / 2 over the sum of
// n^2 with its root term halved. A beam's joint has EI / l = m l^2 K with a mass m proportional to
// l, so K is proportional to 1 / l^4.
//
// Friction leaves a fraction of the velocity per reference step, hence its power dt / h0 per
// substep.

inline constexpr double kReferenceStep = 1.0 / 60.0;  // h0, s
inline constexpr double kReferenceIterations = 10.0;  // n0
inline constexpr double kReferenceSegment = 0.15 / 7.0;  // l0, m
// Per iteration, as in the thesis's program.
inline constexpr double kGreatestLocalStiffness = 0.95;

// Returns the fraction of the velocity left after a substep.
double velocityKept(const SimulationSettings& settings, const gpu::Step& step);

// Returns k_G of thesis eq. 10 for one substep, in [0, 1].
double globalStiffness(const SimulationSettings& settings, const gpu::Step& step);

// Returns k_L of thesis eq. 11 for one iteration, in [0, kGreatestLocalStiffness].
// `segment_length`: mean rest length of the strand's segments, m. A strand without length gets the
// greatest stiffness.
double
localStiffness(const SimulationSettings& settings, const gpu::Step& step, double segment_length);

// Returns substep^2 times the stiffness over vertex mass of the local constraint with an energy,
// [0, infinity). `segment_length` as above.
double
bendStiffness(const SimulationSettings& settings, const gpu::Step& step, double segment_length);

// Returns the factor from that stiffness to the energy's implicit stiffness. The damping is that of
// an implicit reference step, however short a substep is.
double bendDamping(const gpu::Step& step);

// Returns gravity at the start, in the groom's frame on its head, m/s^2.
glm::dvec3 gravityOnGroom(const SimulationSettings& settings);

}  // namespace hair::simulation
