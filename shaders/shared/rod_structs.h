#ifndef HAIRBENCH_ROD_STRUCTS_H
#define HAIRBENCH_ROD_STRUCTS_H

// Data that the solvers of rods share between host and device: `rod`, `stable_cosserat`,
// `position_based_rod` and `augmented_mass_spring`. Scalar layout; addresses are device addresses.
// Each strand has its own units, in which 32 bits are accurate: lengths in its mean segment length,
// masses in the mass of a segment of that length, time in substeps. Arrays are of vec4,
// [vertex][row][strand], so that neighbouring invocations access neighbouring vectors. Segment i
// ends in vertex i, and entry 0 of a segment array belongs to the follicle.

// Invocations in a work group of simulation/rod.comp and simulation/rod_adopt.comp; each has one
// strand.
const uint kRodGroupSize = 32u;

// Rows of a segment.
const uint kRodSegmentRows = 2u;
const uint kRodHalfRotation = 0u;  // half of the rest rotation from the segment above to this one;
                                   // entry 0: the follicle's orientation at rest
const uint kRodStiffness = 1u;  // rest length; mass of the vertex at its end; stiffness per radian
                                // of the joint at its start, against bending and against twisting

// Rows of the motion of a segment and of the vertex at its end. The w of the last three rows are
// the x, y and z of the carried contact force, as the displacement of the vertex in a substep.
const uint kRodMotionRows = 4u;
const uint kRodOrientation = 0u;  // unit quaternion; rotates z to the segment's direction
const uint kRodAngularVelocity = 1u;  // in world axes
const uint kRodVelocity = 2u;
const uint kRodResidual = 3u;  // difference between the edge and the segment's length along its
                               // direction, after collisions

// Rows of accelerations, per substep squared, for `rod` with generalised alpha: of the vertex and
// round the segment. Each has the acceleration that moved the velocities and the true one from
// forces and inertia. In entry 0, x of the first row is 1 if the strand's next substep is implicit
// Euler.
const uint kRodAccelerationRows = 4u;
const uint kRodAcceleration = 0u;
const uint kRodTrueAcceleration = 1u;
const uint kRodAngularAcceleration = 2u;
const uint kRodTrueAngularAcceleration = 3u;

// Rows of scratch memory, for the strands of a dispatch.
const uint kRodScratchRows = 9u;
const uint kRodContactScratchRows = 2u;  // additional rows if `rod` carries contact forces
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
    uint most_strands;  // most strands of a dispatch
    uint iterations;
    float stretching;  // modulus of stretch and shear over the density, times the substep squared,
                       // m^2; not used by `rod`
    float ellipticity;  // of the cross-section: stiffness round the first axis of a segment's frame
                        // is a joint's times this, round the second axis a joint's over this
    // Only for `augmented_mass_spring`. `integrity` is the stiffness of the integrity springs over
    // the mass, times the substep squared. `angular` is the stiffness of the angular springs over
    // the line density, times the substep squared, m^2.
    float integrity;
    float angular;
    float damping;  // for `rod`: damping of the material, over the substep
    // For `rod`: set. `set_kept` is the share of a strain that is left after a substep; `set_mean`
    // is the mean of that share during the substep.
    float set_share;
    Address set;  // vec4 [vertex][strand], half of a joint's strain from rest at which the share of
                  // its stiffness that yields has no torque; 0: hair takes no set
    float set_kept;
    float set_mean;
};

#endif
