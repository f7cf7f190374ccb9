#pragma once

#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

#include "hair/reference/rod.h"

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
// The rest is ours, because we had no access to the paper's equations. Springs against bending and
// torsion join particles two and three apart, as in Selle, Lentine and Fedkiw 2008, A mass spring
// model for hair simulation. Every spring has the energy E A L / 2 (d / L - 1)^2 with its rest
// length L: the one constant is a modulus, so that hair does not depend on its segments. The
// integrity spring has the energy m kappa_I / 2 |x - x_ghost|^2. The angular spring turns the
// segment that ends in the particle. Its energy is lambda kappa_a l / 2 angle^2, with the angle
// between the directions of the segment and of its ghost; it acts as a couple on both particles of
// the segment. A step is implicit Euler. Each iteration is a Newton step with the positive part of
// each spring's Hessian: a spring shorter than its rest length is stiff only along itself. The
// seven diagonals consist of 3 x 3 blocks. Orientations are only the directions of the edges, for
// air. The paper's hair-hair contact on a grid is not here: /simulation/hair_hair has it for every
// solver.
namespace hair::reference {

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
