#pragma once

#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

#include "hair/reference/rod.h"

// One strand by Amador Herrera, Zhou, Sun, Shu, He, Pirk and Michels 2024, Augmented mass-spring
// model for real-time dense hair simulation (arXiv 2412.17144), in double: what the
// `augmented_mass_spring` solver on the GPU is tested against, and shares nothing with.
//
// The paper's, as its abstract and project page have it: particles with springs of one constant
// along edges, against bending and against torsion; a ghost of the rest shape that goes with the
// head and takes no force, to which each particle is coupled by an integrity spring, whose tension
// is in proportion to the particle's distance from its ghost, and by an angular spring, whose
// tension is in proportion to the angle of deviation; a matrix of seven diagonals, decomposed
// directly.
//
// Ours is all that these leave open, for we had no access to the paper's equations. Springs against
// bending and torsion join particles two and three apart, as in Selle, Lentine and Fedkiw 2008, A
// mass spring model for hair simulation, and every spring has the energy E A L / 2 (d / L - 1)^2, L
// its length at rest: the one constant is a modulus, so that hair does not depend on its segments.
// The integrity spring has the energy m kappa_I / 2 |x - x_ghost|^2. The angular spring turns the
// segment that ends in the particle, lambda kappa_a l / 2 angle^2 between its direction and its
// ghost's, a couple on both of its particles. A step is implicit Euler; each of its iterations is a
// Newton step whose Hessian is what is positive of each spring's: a spring that is shorter than at
// rest is stiff along itself alone. The seven diagonals are of blocks of 3 x 3. Orientations are
// nothing but the direction of the edges, for air. Of the paper's hair on hair, on a grid, there is
// nothing here: it is /simulation/hair_hair for every solver.
namespace hair::reference {

struct AugmentedMassSpringParameters {
    double substep = 1.0 / 480.0;  // s
    double velocity_kept = 1.0;
    double spring_stiffness = 0.0;  // E A, N
    double integrity = 0.0;  // kappa_I, 1/s^2
    double angular_stiffness = 0.0;  // lambda kappa_a, N
    std::uint32_t iterations = 2;
};

// One step under these accelerations of the vertices, m/s^2, with the ghost where `root` has it at
// the step's end, and in this air, if any. Velocities are multiplied by `velocity_kept` first.
void stepAugmentedMassSpring(
    RodState& state, const RodRest& rest, std::span<const glm::dvec3> accelerations,
    const RodRoot& root, const AugmentedMassSpringParameters& parameters,
    const RodAir* air = nullptr);

}  // namespace hair::reference
