#pragma once

#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

#include "hair/reference/rod.h"

// One strand by Kugelstadt and Schoemer 2016, Position and orientation based Cosserat rods, in
// double: what the `position_based_rod` solver on the GPU is tested against, and shares nothing
// with.
//
// The paper's: positions with masses at vertices, unit quaternions with a scalar inertia on
// segments, both integrated by themselves and then corrected, constraint by constraint, so that
//     C_s = (x_i - x_(i-1)) / l - d3(q_i) = 0       of a segment's stretch and shear and
//     C_b = Im(conj(q_(i-1)) q_i) - phi Im(q_rest) = 0  of a joint's bend and twist,
// phi = 1 or -1, whichever is nearer; quaternions are corrected as four numbers and made unit
// again; velocities are what all of it moved; constraints go in bilateral interleaving order, every
// other one from the root down and, by turns, those between from the tip up (Umetani, Schmidt and
// Stam 2014, Position-based elastic rods).
//
// Macklin, Mueller and Chentanez 2016, XPBD: in place of a stiffness in [0, 1] the compliance
// alpha, by the multipliers that constraints add up in a step, delta lambda =
// -(C + alpha lambda / h^2) / (grad C W grad C^T + alpha / h^2).
//
// Ours: compliances from SI units, 1 / (E A l) for C_s, shear as stiff as stretch, and 1 / (4 K_c)
// for the components of C_b, K_c the stiffness against bending or twisting over the joint's
// length; C_b in the frame halfway between the two at rest, where it is Im(r), r the rotation from
// one to the other. A quaternion's mass is four times the inertia. Air makes vertices heavier
// across the hair alone.
namespace hair::reference {

struct PositionBasedRodParameters {
    double substep = 1.0 / 1920.0;  // s
    double velocity_kept = 1.0;
    double stretch_stiffness = 0.0;  // E A, N
    std::uint32_t iterations = 4;
};

// One step under these accelerations of the vertices, m/s^2, with the follicle where `root` has it
// at the step's end, and in this air, if any. Velocities are multiplied by `velocity_kept` first.
void stepPositionBasedRod(
    RodState& state, const RodRest& rest, std::span<const glm::dvec3> accelerations,
    const RodRoot& root, const PositionBasedRodParameters& parameters, const RodAir* air = nullptr);

}  // namespace hair::reference
