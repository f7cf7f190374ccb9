#pragma once

#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

#include "hair/reference/rod.h"

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
namespace hair::reference {

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

}  // namespace hair::reference
