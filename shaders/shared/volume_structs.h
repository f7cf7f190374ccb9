#ifndef HAIRBENCH_VOLUME_STRUCTS_H
#define HAIRBENCH_VOLUME_STRUCTS_H

// What the host and the compute code of the contact of hair with hair share (hair_hair.h). Scalar
// layout; addresses are device addresses.

// The grids' sums are in fixed point, whose scale is that of a block of cells: 4 x 4 x 4 of them,
// which have all but the lowest two bits of their places in common.
const uint kVolumeBlockBits = 2u;

// The share 1, all of the groom's length, in units of VolumeBlock::share.
const uint kVolumeBlockOne = 0x80000000u;

// Of the vertices that add to any cell of a block.
struct VolumeBlock {
    uint share;    // the sum, each rounded up
    uint fastest;  // bits of the greatest component of a velocity, m/s
};

// Grids, half a cell apart along each axis.
const uint kVolumeGrids = 2u;

// Cells between the points that hair may be in and the grid's faces: a point's 3 x 3 x 3 cells and
// their neighbours then lie in the grid.
const uint kVolumeMargin = 2u;

// A guide vertex as the grid sees it.
struct VolumeSample {
    vec3 point;     // where it is at the end of the step if it keeps its velocity, cells
    float share;    // of the groom's length; the mass that weighs it here
    vec3 velocity;  // m/s, axes of the world
    float unused;
};

// What the grids of a simulation have for its whole life.
struct VolumeParameters {
    Address shares;   // float [strand][vertex]
    Address samples;  // VolumeSample [strand][vertex]
    Address sums;     // int [grid][z][y][x][4], fixed point of the block: share, momentum
    Address blocks;   // VolumeBlock [grid][z][y][x]
    vec3 origin;       // corner of the first grid on the head, m
    float cell;        // m
    uint resolution;   // cells a side
    float crowded;     // share per cell from which hair repels hair
    float settled;     // part of a difference of velocities that friction takes in a step
    float foreseen;    // and of what all else adds to the difference in a step
    float per_step;    // 1 / the time step, 1/s
    float repulsion;   // m/s^2
    float greatest_repulsion;  // m/s^2
    uint borrows;  // 1: the last component of sums lacks 1 where the one before it is negative
    Address kept;  // vec4 [strand][vertex]: what friction left of the difference in the step
                   // before, m/s; w = 1 where there was one, else 0
};

// Push constants of every pass of the grid.
struct VolumePush {
    Address guides;         // GuideParameters
    Address volume;         // VolumeParameters
    Address accelerations;  // m/s^2, added to by simulation/volume_force.comp
    RigidFrame frame;        // of the head at the end of the step
};

#endif
