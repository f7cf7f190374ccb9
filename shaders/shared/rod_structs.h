#ifndef HAIRBENCH_ROD_STRUCTS_H
#define HAIRBENCH_ROD_STRUCTS_H

// What the solvers of rods share on host and device: `rod`, `stable_cosserat`, `position_based_rod`
// and `augmented_mass_spring`. Scalar layout; addresses are device addresses. Each strand is
// simulated in units of its own, in which 32 bits are accurate: lengths in its mean segment length,
// masses in the mass of a segment that long, time in substeps. Arrays are of vec4,
// [vertex][row][strand], so that neighbouring invocations touch neighbouring vectors; segment i
// ends in vertex i, and entry 0 of what segments have is the follicle's.

// Invocations, each with a strand, in a workgroup of simulation/rod.comp and
// simulation/rod_adopt.comp.
const uint kRodGroupSize = 32u;

// Rows of a segment.
const uint kRodSegmentRows = 2u;
const uint kRodHalfRotation = 0u;  // at rest, half of the way from the segment above to this one;
                                   // entry 0: the follicle's orientation at rest
const uint kRodStiffness = 1u;  // rest length; mass of the vertex where it ends; stiffness of the
                                // joint where it starts, per radian, against bending and twisting

// Rows of how a segment and the vertex where it ends move. The last three's w are x, y and z of the
// force of contact that is carried, by how far it would move the vertex in a substep.
const uint kRodMotionRows = 4u;
const uint kRodOrientation = 0u;  // unit quaternion; takes z to the segment's direction
const uint kRodAngularVelocity = 1u;  // axes of space
const uint kRodVelocity = 2u;
const uint kRodMisfit = 3u;  // by how much its edge is not its length along its direction: after
                             // collisions

// Rows of accelerations, per substep squared, where `rod` integrates by generalised alpha: of the
// vertex, and round the segment, each as the velocities took it and as forces and inertia have it.
// Entry 0: x of the first is 1 where the strand's next substep is implicit Euler.
const uint kRodAccelerationRows = 4u;
const uint kRodAcceleration = 0u;
const uint kRodTrueAcceleration = 1u;
const uint kRodAngularAcceleration = 2u;
const uint kRodTrueAngularAcceleration = 3u;

// Rows of scratch memory, of the strands of a dispatch.
const uint kRodScratchRows = 9u;
const uint kRodContactScratchRows = 2u;  // more where `rod` carries forces of contact
const uint kStableCosseratScratchRows = 4u;
const uint kPositionBasedScratchRows = 5u;
const uint kMassSpringScratchRows = 13u;

// Parameters of the solvers of rods and of simulation/rod_adopt.comp.
struct RodParameters {
    Address segments;  // vec4 [vertex][kRodSegmentRows][strand]
    Address units;  // float [strand], m
    Address motion;  // vec4 [vertex][kRodMotionRows][strand]
    Address scratch;  // vec4 [vertex][the solver's scratch rows][strand of the dispatch]
    Address accelerations;  // vec4 [vertex][kRodAccelerationRows][strand]; 0: implicit Euler
    uint most_strands;  // of a dispatch
    uint iterations;
    float stretching;  // modulus of stretch and shear over the density, times the substep squared,
                       // m^2; `rod` has none
    float ellipticity;  // of the cross-section: the stiffness round the first axis of a segment's
                        // frame is a joint's times that, round the second one over that
    // Of `augmented_mass_spring` alone: of the integrity springs, over the mass and times the
    // substep squared, and of the angular springs, over the line density and times the substep
    // squared, m^2.
    float integrity;
    float angular;
    float damping;  // of `rod`: the material's, over the substep
};

#endif
