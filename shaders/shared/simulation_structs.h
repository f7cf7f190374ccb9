#ifndef HAIRBENCH_SIMULATION_STRUCTS_H
#define HAIRBENCH_SIMULATION_STRUCTS_H

// Data that the simulation's host and compute code share. Include distance_field_structs.h first.
// Scalar layout; addresses are device addresses. Per-vertex arrays are vec4 [strand][vertex], root
// first; w is unused unless documented.

// Segments shorter than this, m, at rest or now, have no direction of their own.
const float kShortestSegment = 1.0e-9f;

// Invocations in a work group of the passes over all guides or guide vertices. Rods and shape
// constraints have their own sizes.
const uint kGuideGroupSize = 64u;

// Purposes kWindWeightPurpose to kWindWeightPurpose + 3 give the random numbers by which a strand
// weights the wind's four directions.
const uint kWindWeightPurpose = 0x57494e44u;

// A rigid motion from the groom's original pose to its current pose: x -> rotation x + translation.
struct RigidFrame {
    vec4 rotation;  // unit quaternion, w the scalar part
    vec3 translation;  // m
};

// The frame that a body follows.
const uint kFollowsHead = 0u;
const uint kFollowsWorld = 1u;

// A capsule, or a sphere if a == b, in the pose where its frame is the identity.
struct Capsule {
    vec3 a;  // one end of the axis, m
    float radius;  // m
    vec3 b;  // the other end, m
    uint follows;
};

struct BodyField {
    DistanceField field;
    uint follows;
    uint unused;
};

// The bodies that hair collides with.
struct Bodies {
    Address capsules;  // Capsule [capsule_count]
    Address fields;  // BodyField [field_count]
    uint capsule_count;
    uint field_count;
    float margin;  // m; the margin of guides' vertices is in GuideParameters::rest_positions
    float friction;  // Coulomb's coefficient
};

// The fixed step of simulated time and the solver's substeps in it. Accelerations and the air's
// velocity are computed at a step's start and held until its end. A vertex's velocity is the
// difference of its positions over a substep, divided by the substep.
struct Step {
    float whole;  // s
    float sub;  // s, whole / count
    uint count;  // substeps in a step
};

// Data of a simulation's guides for its whole life.
struct GuideParameters {
    Address positions;  // m; w = inverse mass relative to a vertex's: 0 if pinned (the root), else
                        // 1
    Address previous;  // m, one substep earlier; w = 1 at vertices in contact with a body and all
                       // vertices below them on the strand, else 0
    Address rest_positions;  // m; w = margin between the vertex and bodies, m
    Bodies bodies;
    vec3 gravity;  // m/s^2
    Step step;
    float velocity_kept;  // fraction of the velocity that remains after a substep
    uint strand_count;
    uint vertices_per_strand;
    uint seed;
};

// Air with velocity u across a hair accelerates it by (inertial |u| + viscous |u|^(1/3)) u.
struct AirDrag {
    float inertial;  // rho_air / (pi r rho), 1/m
    float viscous;  // 10 (mu / (rho_air 2 r))^(2/3) times `inertial`, m^(-1/3) s^(-2/3)
};

// Push constants of a solver's substep.
struct SubstepPush {
    Address guides;  // GuideParameters: positions and previous positions are written
    Address from;  // GuideParameters at the start of the substep; may be `guides`
    Address solver;  // the solver's own parameters
    Address accelerations;  // m/s^2, besides gravity; address 0: none
    Address air;  // the air's velocity at the vertices, m/s; address 0: no drag
    RigidFrame frame;  // of the head at the end of the substep
    RigidFrame frame_before;  // of the head at the start of the substep
    Address roots;  // RigidFrame [strand], at the end; read if kSkinnedRoots
    Address roots_before;  // RigidFrame [strand], at the start
    uint first_strand;  // first strand that this dispatch moves
    AirDrag drag;
};

// Push constants of simulation/segments.comp.
struct SegmentPush {
    Address guides;  // GuideParameters: positions are moved, and contact is marked in `previous`
    Address starts;  // positions at the start of the substep, m
    RigidFrame frame;  // of the head at the end of the substep
    RigidFrame frame_before;  // of the head at the start of the substep
    uint keeps_rest;  // 1: no segment is pushed farther out than it is at rest
};

// Push constants of simulation/wind.comp.
struct WindPush {
    Address guides;  // GuideParameters
    Address accelerations;  // m/s^2, written
    vec3 directions[4];  // unit vectors round the wind's direction times its strength, m/s^2
    float magnitude;  // thesis eq. 13
};

// Purpose of the random numbers for forces that a scene defines.
const uint kForcePurpose = 0x464f5243u;

// Push constants of simulation/force.comp.
struct ForcePush {
    Address guides;  // GuideParameters
    Address accelerations;  // m/s^2, added to
    float time;  // s, at the start of the time step
};

// Purpose of the random numbers that seed the turbulence's octaves.
const uint kTurbulencePurpose = 0x54555242u;

// Push constants of simulation/air.comp.
struct AirPush {
    Address guides;  // GuideParameters
    Address accelerations;  // m/s^2, written: by the drag along the hair
    Address air;  // vec4: velocity of the air, m/s, written
    vec3 mean_wind;  // m/s
    float fluctuation;  // r.m.s. of each component, m/s
    // Position of the world's origin in the lattice of the largest eddies, which moves with the
    // mean wind.
    uvec3 cell;  // modulo 2^32
    vec3 fraction;  // of the cell, [0, 1)
    float cells_per_metre;
    uint octaves;
    float drag_along;  // rate of the drag along the hair, 1/s
};

// Push constants of simulation/pull_hold.comp and simulation/pull.comp.
struct PullPush {
    Address guides;  // GuideParameters
    Address accelerations;  // m/s^2, added to
    Address held;  // vec4: the acceleration of the held vertex, m/s^2
    vec3 hand;  // at the end of the time step, m
    vec3 hand_velocity;  // m/s
    uint held_vertex;  // of [strand][vertex]
    float radius;  // m
    float stiffness;  // 1/s^2
    float damping;  // 1/s
    float implicit;  // 1 / (1 + damping step.whole + stiffness step.whole^2)
};

// Samples of a cache round a time; vec4 [strand][vertex], in the pose before the head moves, m.
struct CachePlace {
    Address before;
    Address after;
    float fraction;  // of the way between them
};

// Push constants of simulation/cache_rest.comp.
struct CacheRestPush {
    Address rest_positions;  // of the guides; written, except for their margins
    Address goals;  // of the solver, written; address 0: none
    Address goal_offsets;  // vec4 [strand][vertex]: goals from rest positions, m
    CachePlace place;
    uint vertex_count;
};

// Push constants of simulation/cache_follow.comp.
struct CacheFollowPush {
    Address guides;  // GuideParameters; their rest positions are the cache's at the step's start
    Address accelerations;  // m/s^2, added to
    CachePlace place;  // at the step's end
    RigidFrame frame_before;  // of the head at the step's start
    RigidFrame frame;  // at its end
    float stiffness;  // 1/s^2
};

// Push constants of simulation/interpolate.comp.
struct InterpolatePush {
    Address from;  // vec4 [vertex]
    Address to;  // vec4 [vertex]
    Address drawn;  // vec4 [vertex], written
    float share;  // 0: from, 1: to
    uint vertex_count;
};

// The condition of a vertex, from simulation/condition.comp.
struct VertexCondition {
    float stretch;  // of the segment that ends here, over its rest length; 1 without a segment
    float gap;  // to the nearest body, without its margin, negative inside; infinite at roots, m
    float moved;  // in the last substep, m
};

// Push constants of simulation/condition.comp.
struct ConditionPush {
    Address guides;  // GuideParameters
    Address conditions;  // VertexCondition [strand][vertex]
    RigidFrame frame;  // of the head now
};

// Quantities that simulation/probe.comp computes, as bits of ProbePush::quantities.
const uint kProbesTip = 1u;
const uint kProbesLength = 2u;
const uint kProbesMotion = 4u;  // energy, momentum and speed
const uint kProbesContact = 8u;
const uint kProbesBending = 16u;
const uint kProbesTorsion = 32u;
const uint kProbesElastic = 64u;
const uint kProbesGroom = 128u;

// Rows of a guide's quantities.
const uint kProbeTip = 0u;  // m
const uint kProbeStrain = 1u;  // mean and greatest
const uint kProbeMostStrain = 2u;
const uint kProbeKinetic = 3u;  // J, and the next two
const uint kProbeGravitational = 4u;
const uint kProbeElastic = 5u;
const uint kProbeContacts = 6u;  // vertices
const uint kProbeDepth = 7u;  // m
const uint kProbeSpeed = 8u;  // m/s
const uint kProbeBending = 9u;  // mean and greatest, rad
const uint kProbeMostBending = 10u;
const uint kProbeTorsion = 11u;  // mean and greatest, rad
const uint kProbeMostTorsion = 12u;
const uint kProbeMomentum = 13u;  // along x, y and z, kg m/s
const uint kProbeDistance = 16u;  // mean and greatest, m
const uint kProbeMostDistance = 17u;
const uint kProbeRows = 18u;

// Push constants of simulation/probe.comp.
struct ProbePush {
    Address guides;  // GuideParameters
    Address rest;  // vec4 [strand][vertex]: the groom, m; w = mass of a vertex, kg
    Address reference;  // vec4 [strand][vertex]: where groom_distance measures to, m
    Address rows;  // float [row][guide], written
    Address roots;  // RigidFrame [strand] now; read if kSkinnedRoots
    Address rods;  // RodParameters of `rod`; address 0: no elastic energy
    RigidFrame frame;  // of the head now
    uint first_guide;
    uint guide_count;
    uint quantities;
    float line_density;  // kg/m
};

// How simulation/probe_reduce.comp combines a row of all guides.
const uint kProbeSum = 0u;
const uint kProbeMean = 1u;
const uint kProbeGreatest = 2u;
const uint kProbeRank = 3u;  // the value at a rank of the sorted ones

struct ProbeResult {
    uint row;
    uint combined;
    uint rank;  // from 0
    float factor;  // on the result
};

// Invocations in a work group of simulation/probe_reduce.comp, and values of a digit.
const uint kProbeGroupSize = 256u;

// Push constants of simulation/probe_reduce.comp.
struct ProbeReducePush {
    Address rows;  // float [row][guide]
    Address wanted;  // ProbeResult [result]
    Address results;  // float [result], written
    uint guide_count;
};

// Parameters of simulation/shape.comp.
struct ShapeParameters {
    Address rest_positions;  // target positions of the global constraint, m
    Address rest_edges;  // hair/simulation/solver_shape.h
    Address local_stiffness;  // float [strand]: factor per iteration, or substep^2 K of an energy
    float global_stiffness;  // factor per substep
    uint local_iterations;
    uint length_iterations;
    float local_damping;  // multiple of an energy's implicit stiffness
};

// Parameters of simulation/ftl.comp.
struct FtlParameters {
    float global_stiffness;  // factor per substep
    float velocity_correction;  // s_damping of Mueller et al. 2012, eq. 9
};

// Memory of a solver from the scene, vec4 for each vertex.
const uint kExtendedMemory = 4u;

// Parameters of simulation/extended.comp.
struct ExtendedParameters {
    Address earlier;  // vec4 [strand][vertex]: previous positions at the start of the substep, m
    Address memory;  // vec4 [strand][vertex][kExtendedMemory]
    float density;  // kg/m^3, of /simulation/material like the rest
    float radius;  // m
    float ellipticity;
    float youngs_modulus;  // Pa
    float shear_modulus;  // Pa
    float damping;  // s
};

#endif
