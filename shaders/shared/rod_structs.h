#ifndef HAIRBENCH_ROD_STRUCTS_H
#define HAIRBENCH_ROD_STRUCTS_H

// What the `rod` solver's host and compute code share. Scalar layout; addresses are device
// addresses. Each strand is simulated in units of its own, in which 32 bits are accurate: lengths
// in its mean segment length, masses in the mass of a segment that long, time in substeps. Arrays
// are [vertex][strand], so that neighbouring invocations touch neighbouring addresses; segment i
// ends in vertex i, and entry 0 of what segments have is the follicle's.

// Invocations, each with a strand, in a workgroup of simulation/rod.comp and
// simulation/rod_adopt.comp.
const uint kRodGroupSize = 32u;

struct RodSegment {
    vec4 half_rotation;  // at rest, half of the way from the segment above to this one; entry 0:
                         // the follicle's orientation at rest
    float rest_length;
    float mass;  // of the vertex where it ends
    float bend_stiffness;  // of the joint where it starts, per radian
    float twist_stiffness;
};

// How a segment and the vertex where it ends move.
struct RodMotion {
    vec4 orientation;       // unit quaternion; takes z to the segment's direction
    vec3 angular_velocity;  // axes of space
    vec3 velocity;
    vec3 misfit;  // by how much its edge is not its length along its direction: after collisions
};

// Rows of scratch memory per vertex, vec4 [vertex][row][strand of the dispatch].
const uint kRodScratchRows = 8u;

// Parameters of simulation/rod.comp and simulation/rod_adopt.comp.
struct RodParameters {
    Address segments;  // RodSegment [vertex][strand]
    Address units;     // float [strand], m
    Address motion;    // RodMotion [vertex][strand]
    Address scratch;
    uint most_strands;  // of a dispatch
    uint iterations;
};

#endif
