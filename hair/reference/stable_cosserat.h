#pragma once

#include <cstdint>
#include <span>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "hair/reference/rod.h"

// One strand by Hsu, Wang, Wu and Yuksel 2025, Stable Cosserat rods (SIGGRAPH Conference Papers),
// in double: what the `stable_cosserat` solver on the GPU is tested against, and shares nothing
// with.
//
// The paper's: positions x at vertices, unit quaternions q on segments, and the energies
//     E_ss = k_ss / 2 |(x_i - x_(i-1)) / l - d3(q_i)|^2  of a segment's stretch and shear,
//     E_bt = k_bt / 2 |conj(q_(i-1)) q_i - phi q_rest|^2  of a joint's bend and twist,
// phi = 1 or -1, whichever is nearer; implicit Euler as the minimum of
// |x - y|^2_M / (2 h^2) + E_ss + E_bt, y where the vertices would go by themselves, by turns over x
// with q held and over q with x held and |q| = 1, without the inertia of rotation; the orientation
// of one segment in closed form, q = (v b e3 + lambda b) / (lambda^2 - |v|^2) with
// v = -2 k_ss (x_i - x_(i-1)) / l, b the sum of what its neighbours want, and lambda the multiplier
// of |q| = 1.
//
// Ours: positions are the exact minimum for these orientations, a tridiagonal system, where the
// paper descends vertex by vertex; lambda is exact, where the paper takes |v| + |b|; each sweep
// over the orientations goes from the root down with the neighbours' newest, and the first is at y.
// A hair resists bending and twisting otherwise: with r the rotation from one frame to the other
// and K the greater of both stiffnesses over the joint's length,
//     E_bt = 4 K (1 - |r.w|) - 2 sum over x, y, z of (K - K_c) r_c^2,
// which is the paper's for K_bend = K_twist, and K_c angle^2 / 2 for small angles. The sum is made
// linear where the iteration stands: E_bt is concave in it, so that every update still lowers the
// energy. So is the excess of the mass along hair that air makes heavier across alone. k_ss is a
// modulus of its own times the cross-section and l: with that of the hair, 10^4 times as great,
// positions and orientations would hold each other.
namespace hair::reference {

struct StableCosseratParameters {
    double substep = 1.0 / 960.0;  // s
    double velocity_kept = 1.0;
    double stretch_stiffness = 0.0;  // modulus times cross-section, N: k_ss / l
    std::uint32_t iterations = 8;
};

// One step under these accelerations of the vertices, m/s^2, with the follicle where `root` has it
// at the step's end, and in this air, if any. Velocities are multiplied by `velocity_kept` first.
void stepStableCosserat(
    RodState& state, const RodRest& rest, std::span<const glm::dvec3> accelerations,
    const RodRoot& root, const StableCosseratParameters& parameters, const RodAir* air = nullptr);

// Moves the vertices to `positions`, as collisions do: velocities change by as much. Orientations
// follow in the next step.
void pushVertices(RodState& state, std::span<const glm::dvec3> positions, double substep);

// E_bt of joint i, J.
double
bendTwistEnergy(const RodRest& rest, std::span<const glm::dquat> orientations, std::size_t i);

// The unit quaternion q with the greatest b . q + edge . d3(q), d3 the third axis of its frame. b
// is not 0.
glm::dquat balancedOrientation(const glm::dquat& b, const glm::dvec3& edge);

}  // namespace hair::reference
