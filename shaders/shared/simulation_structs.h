#ifndef HAIRBENCH_SIMULATION_STRUCTS_H
#define HAIRBENCH_SIMULATION_STRUCTS_H

// What the simulation's host and compute code share. Scalar layout; addresses are device addresses.
// Per-vertex arrays are vec4 [strand][vertex], root first; w is unused where nothing is said of it.

// Shorter segments, at rest or now, have no direction of their own. m
const float kShortestSegment = 1.0e-9f;

// Purpose of the random numbers that a strand weighs the wind with; the next three are taken too.
const uint kWindWeightPurpose = 0x57494e44u;

// A sphere where a == b.
struct Capsule {
    vec3 a;  // one end of the axis, m
    float radius;  // m
    vec3 b;  // the other end, m
};

// Push constants of simulation/wind.comp.
struct WindParameters {
    uint64_t positions;  // m
    uint64_t accelerations;  // m/s^2, written
    vec3 directions[4];  // unit vectors round the wind's direction times its strength, m/s^2
    float magnitude;  // thesis eq. 13
    uint seed;
    uint strand_count;
    uint vertices_per_strand;
};

// Push constants of simulation/simulate.comp.
struct SimulateParameters {
    uint64_t positions;  // m; w = inverse mass, 1/kg: 0 at the root, 1 elsewhere
    uint64_t previous;  // m, one step earlier
    uint64_t rest_positions;  // m
    uint64_t rest_edges;  // hair/simulation/rest_shape.h
    uint64_t local_stiffness;  // float [strand]: factor per iteration
    uint64_t accelerations;  // m/s^2, beside gravity; address 0: none
    uint64_t capsules;  // Capsule [capsule_count]
    vec3 gravity;  // m/s^2
    float time_step_squared;  // s^2
    float velocity_kept;  // fraction of the velocity that is left after a step
    float global_stiffness;  // factor per step
    uint local_iterations;
    uint length_iterations;
    uint capsule_count;
    uint strand_count;
    float collision_margin;  // m
    float friction;  // Coulomb's coefficient
};

#endif
