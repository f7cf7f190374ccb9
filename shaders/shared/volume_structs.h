#ifndef HAIRBENCH_VOLUME_STRUCTS_H
#define HAIRBENCH_VOLUME_STRUCTS_H

// Data that the host and the compute code of hair-hair contact share (hair_hair.h). Scalar layout;
// addresses are device addresses.

// The grids' sums are in fixed point. Each block of cells has its own scale. A block is 4 x 4 x 4
// cells, with coordinates that differ only in the lowest two bits.
const uint kVolumeBlockBits = 2u;

// A share of 1, the groom's whole length, in units of VolumeBlock::share.
const uint kVolumeBlockOne = 0x80000000u;

// Bounds over the vertices that add to any cell of a block.
struct VolumeBlock {
    uint share;    // the sum, each term rounded up
    uint fastest;  // bits of the greatest component of a velocity, m/s
};

// Grids, half a cell apart along each axis.
const uint kVolumeGrids = 2u;

// Cells between the hair's range and the grid's faces, so that a point's 3 x 3 x 3 cells and their
// neighbours lie in the grid.
const uint kVolumeMargin = 2u;

// A guide vertex as input of the grid.
struct VolumeSample {
    vec3 point;     // position at the end of the step at constant velocity, cells
    float share;    // of the groom's length; it serves as the mass here
    vec3 velocity;  // m/s, world axes; with a yield stress: YieldPush
    float unused;
};

// Data of a simulation's grids for its whole life.
struct VolumeParameters {
    Address shares;   // float [strand][vertex]
    Address samples;  // VolumeSample [strand][vertex]
    Address sums;     // int [grid][z][y][x][4], fixed point of the block: share, momentum
    Address blocks;   // VolumeBlock [grid][z][y][x]
    vec3 origin;       // corner of the first grid on the head, m
    float cell;        // m
    uint resolution;   // cells a side
    float crowded;     // share per cell from which hair repels hair
    float settled;     // part of a velocity difference that friction removes in a step
    float predicted;  // the same part for what everything else adds to the difference in a step
    float per_step;  // 1 / the time step, 1/s
    float repulsion;  // m/s^2
    float greatest_repulsion;  // m/s^2
    uint borrows;  // 1: the last component of a sum lacks 1 if the third is negative
    Address kept;  // vec4 [strand][vertex]: velocity difference that friction left in the step
                   // before, m/s; with a yield stress the elastic displacement in a step, m/s; w =
                   // 1 if there was a step before, else 0
};

// Push constants of every pass of the grid.
struct VolumePush {
    Address guides;  // GuideParameters
    Address volume;  // VolumeParameters
    Address accelerations;  // m/s^2, added to by simulation/volume_force.comp
    RigidFrame frame;  // of the head at the end of the step
};

// Push constants of passes of the grid where hairs stick to each other up to a yield stress, except
// simulation/volume_splat.comp. VolumeSample::velocity is then the stress's potential: the elastic
// displacement in a step plus the velocity relative to the head, m/s, in the head's axes.
struct YieldPush {
    Address guides;  // GuideParameters
    Address volume;  // VolumeParameters
    Address accelerations;  // m/s^2, added to by simulation/volume_force.comp+yield
    Address spreads;  // uint [grid][z][y][x][2], fixed point of the block: share times the distance
                      // of the potential from the cell's mean, and times its square
    RigidFrame frame;  // of the head at the end of the step
    RigidFrame frame_before;  // of the head at its start
    float pressed;  // jump of the potential at which hair yields under infinite crowding, m/s
    float cohesive;  // that without pressure, m/s
};

// The push constants of simulation/volume_force.comp end with this if hair attracts hair.
struct VolumeAttraction {
    float attraction;  // potential in crowded hair over a cell, m/s^2
    float repulsion;  // VolumeParameters::repulsion
};

// A distance of potentials in units of VolumeBlock::fastest's power of two is below this.
const float kVolumeSpreadRange = 4.0;

// Push constants of simulation/volume_shelter.comp.
struct ShelterPush {
    Address guides;  // GuideParameters
    Address volume;  // VolumeParameters
    Address accelerations;  // m/s^2, less the drag along the hair of the air's lost speed
    Address air;  // vec4 [strand][vertex]: velocity of the air, m/s, slowed
    RigidFrame frame;  // of the head at the end of the step
    float area_per_share;  // frontal area of a share of hair in a cell, over the cell's face
    float viscous;  // AirDrag::viscous over AirDrag::inertial, (m/s)^(2/3)
    float drag_along;  // rate of the drag along the hair, 1/s
};

#endif
