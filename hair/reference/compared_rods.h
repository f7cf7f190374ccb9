#pragma once

#include <cstdint>
#include <span>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "hair/reference/rod.h"
#include "hair/settings.h"

// References for the GPU's rod solvers that serve for comparison with `rod`. They share no code
// with the GPU's.
namespace hair::reference {

// ---- Stable Cosserat rods -----------------------------------------------------------------------

// One strand by Hsu, Wang, Wu and Yuksel 2025, Stable Cosserat rods (SIGGRAPH Conference Papers),
// in double: a reference for the GPU's `stable_cosserat` solver that shares no code with it.
//
// From the paper: positions x at vertices, unit quaternions q on segments, and the energies
//     E_ss = k_ss / 2 |(x_i - x_(i-1)) / l - d3(q_i)|^2  of a segment's stretch and shear,
//     E_bt = k_bt / 2 |conj(q_(i-1)) q_i - phi q_rest|^2  of a joint's bend and twist,
// with phi = 1 or -1, whichever is nearer. A step is implicit Euler, the minimum of
//     |x - y|^2_M / (2 h^2) + E_ss + E_bt,
// where y is the free motion of the vertices. It alternates between x with q fixed and q with x
// fixed and |q| = 1, without rotational inertia. The orientation of one segment has the closed form
// q = (v b e3 + lambda b) / (lambda^2 - |v|^2), with v = -2 k_ss (x_i - x_(i-1)) / l, the sum b of
// its neighbours' pulls, and the multiplier lambda of |q| = 1.
//
// The method `descent` is the paper's. Each iteration goes twice from the root down: it moves every
// vertex to the least energy with everything else fixed, and then turns every segment with lambda =
// |v| + |b|. It starts, as in Chen et al. 2024, Vertex block descent, from the drift plus a share s
// of the free motion's external part e, s = clamp(a . e / |e|^2), with the last step's change a of
// the drift. The first segment keeps its follicle's angle, as the pinned segments of the authors'
// scenes, so that its lower end hangs on a spring.
//
// The method `direct` is ours: positions are the exact minimum for these orientations, by a
// tridiagonal system. lambda is exact. Each sweep over the orientations goes from the root down
// with the neighbours' newest values, and the first is at y. The first segment is joined to its
// follicle.
//
// Ours in both: a hair's stiffnesses against bending and twisting differ. With r the rotation from
// one frame to the other and K the greater of both stiffnesses over the joint's length,
//     E_bt = 4 K (1 - |r.w|) - 2 sum over x, y, z of (K - K_c) r_c^2,
// which is the paper's energy for K_bend = K_twist, and K_c angle^2 / 2 for small angles. The sum
// is linearised at the current iterate: E_bt is concave in it, so every update still lowers the
// energy. Air makes hair heavier only across; the excess of the mass along hair is linearised in
// the same way. k_ss is a modulus of its own times the cross-section and l: with the hair's
// modulus, 10^4 times as great, positions and orientations would hold each other.

struct StableCosseratParameters {
    CosseratMethod method = CosseratMethod::direct;
    double substep = 1.0 / 960.0;  // s
    double velocity_kept = 1.0;
    double stretch_stiffness = 0.0;  // modulus times cross-section, N: k_ss / l
    std::uint32_t iterations = 8;
};

// One step under these vertex accelerations, m/s^2, in this air, if any. `root` places the follicle
// at the end of the step. First multiplies velocities by `velocity_kept`.
void stepStableCosserat(
    RodState& state, const RodRest& rest, std::span<const glm::dvec3> accelerations,
    const RodRoot& root, const StableCosseratParameters& parameters, const RodAir* air = nullptr);

// Moves the vertices to `positions`, as collisions do: velocities change accordingly. Orientations
// follow in the next step.
void pushVertices(RodState& state, std::span<const glm::dvec3> positions, double substep);

// Returns E_bt of joint i, J.
double
bendTwistEnergy(const RodRest& rest, std::span<const glm::dquat> orientations, std::size_t i);

// Returns the unit quaternion q that maximises b . q + edge . d3(q), where d3 is the third axis of
// its frame. b must not be 0.
glm::dquat balancedOrientation(const glm::dquat& b, const glm::dvec3& edge);

// ---- Position-based rods ------------------------------------------------------------------------

// One strand by Kugelstadt and Schoemer 2016, Position and orientation based Cosserat rods, in
// double: a reference for the GPU's `position_based_rod` solver that shares no code with it.
//
// From the paper: positions with masses at vertices, and unit quaternions with a scalar inertia on
// segments. Both are integrated freely and then corrected, constraint by constraint, so that
//     C_s = (x_i - x_(i-1)) / l - d3(q_i) = 0       for a segment's stretch and shear and
//     C_b = Im(conj(q_(i-1)) q_i) - phi Im(q_rest) = 0  for a joint's bend and twist,
// with phi = 1 or -1, whichever is nearer. Quaternions are corrected as four numbers and normalised
// again. Velocities follow from the total movement. Constraints go in bilateral interleaving order:
// every other one from the root down, alternating with the others from the tip up (Umetani, Schmidt
// and Stam 2014, Position-based elastic rods).
//
// From Macklin, Mueller and Chentanez 2016, XPBD: instead of a stiffness in [0, 1] a compliance
// alpha, with multipliers that constraints accumulate in a step,
//     delta lambda = -(C + alpha lambda / h^2) / (grad C W grad C^T + alpha / h^2).
//
// Ours: compliances from SI units, 1 / (E A l) for C_s, with shear as stiff as stretch, and
// 1 / (4 K_c) for the components of C_b, where K_c is the stiffness against bending or twisting
// over the joint's length. C_b is in the frame halfway between the two at rest, where it is Im(r),
// with r the rotation from one frame to the other. A quaternion's mass is four times the inertia.
// Air makes vertices heavier only across the hair.

struct PositionBasedRodParameters {
    double substep = 1.0 / 1920.0;  // s
    double velocity_kept = 1.0;
    double stretch_stiffness = 0.0;  // E A, N
    std::uint32_t iterations = 4;
};

// One step under these vertex accelerations, m/s^2, in this air, if any. `root` places the follicle
// at the end of the step. First multiplies velocities by `velocity_kept`.
void stepPositionBasedRod(
    RodState& state, const RodRest& rest, std::span<const glm::dvec3> accelerations,
    const RodRoot& root, const PositionBasedRodParameters& parameters, const RodAir* air = nullptr);

// ---- Augmented mass-spring model ----------------------------------------------------------------

// One strand by Amador Herrera, Zhou, Sun, Shu, He, Pirk and Michels 2024, Augmented mass-spring
// model for real-time dense hair simulation (arXiv 2412.17144), in double: a reference for the
// GPU's `augmented_mass_spring` solver that shares no code with it.
//
// From the paper's abstract and project page: particles with springs of one constant along edges,
// against bending and against torsion. A ghost of the rest shape moves with the head and takes no
// force. An integrity spring couples each particle to its ghost, with a tension proportional to
// their distance. An angular spring has a tension proportional to the angle of deviation. The
// matrix has seven diagonals and is decomposed directly.
//
// The rest is ours and was not compared with the paper's equations, which arXiv has. Springs
// against bending and torsion join particles two and three apart, as in Selle, Lentine and Fedkiw
// 2008, A mass spring model for hair simulation. Every spring has the energy E A L / 2 (d / L -
// 1)^2 with its rest length L: the one constant is a modulus, so that hair does not depend on its
// segments. The integrity spring has the energy m kappa_I / 2 |x - x_ghost|^2. The angular spring
// turns the segment that ends in the particle. Its energy is lambda kappa_a l / 2 angle^2, with the
// angle between the directions of the segment and of its ghost; it acts as a couple on both
// particles of the segment. A step is implicit Euler. Each iteration is a Newton step with the
// positive part of each spring's Hessian: a spring shorter than its rest length is stiff only along
// itself. The seven diagonals consist of 3 x 3 blocks. Orientations are only the directions of the
// edges, for air. The paper's hair-hair contact on a grid is not here: /simulation/hair_hair has it
// for every solver.

struct AugmentedMassSpringParameters {
    double substep = 1.0 / 480.0;  // s
    double velocity_kept = 1.0;
    double spring_stiffness = 0.0;  // E A, N
    double integrity = 0.0;  // kappa_I, 1/s^2
    double angular_stiffness = 0.0;  // lambda kappa_a, N
    std::uint32_t iterations = 2;
};

// One step under these vertex accelerations, m/s^2, in this air, if any. `root` places the ghost at
// the end of the step. First multiplies velocities by `velocity_kept`.
void stepAugmentedMassSpring(
    RodState& state, const RodRest& rest, std::span<const glm::dvec3> accelerations,
    const RodRoot& root, const AugmentedMassSpringParameters& parameters,
    const RodAir* air = nullptr);

}  // namespace hair::reference
