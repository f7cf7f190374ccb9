// The strand that an invocation of a rod solver moves. Define kScratchRows, the solver's rows of
// scratch memory, first.
#ifndef HAIRBENCH_SIMULATION_ROD_STRAND_GLSL
#define HAIRBENCH_SIMULATION_ROD_STRAND_GLSL

#include "common/rigid_frame.glsl"
#include "simulation/air_drag.glsl"
#include "simulation/constraints/bodies.glsl"
#include "simulation/rod/state.glsl"
#include "simulation/root_frame.glsl"

layout(local_size_x = kRodGroupSize) in;

layout(push_constant, scalar) uniform Push { SubstepPush push; };

const float kLeastLength = 0.1;  // shorter segments have the inertia of this length

GuideParameters guides;
GuideParameters from;
RodParameters rod;
uint strand;
uint root;    // index of the strand's first vertex
float unit;   // m
vec3 root_now;
RigidFrame root_frame;  // at the end of the substep
RigidFrame root_frame_before;

float restLength(uint i) {
    return segmentRow(rod.segments, i, kRodStiffness, guides.strand_count, strand).x;
}

RodMotion motionAt(uint i) { return loadMotion(rod.motion, i, guides.strand_count, strand); }

void setMotion(uint i, RodMotion motion) {
    storeMotion(rod.motion, i, guides.strand_count, strand, motion);
}

uint orientationIndex(uint i) {
    return motionIndex(i, kRodOrientation, guides.strand_count, strand);
}

uint scratchIndex(uint i, uint row) {
    return rodIndex(i, row, kScratchRows, rod.most_strands, strand - push.first_strand);
}

vec4 scratchAt(uint i, uint row) { return loadVector(rod.scratch, scratchIndex(i, row)); }

void setScratch(uint i, uint row, vec4 value) {
    storeVector(rod.scratch, scratchIndex(i, row), value);
}

// Mesa 22's llvmpipe reads x if only the last component is read, so the whole vector is read.
bool isPinned(uint i) {
    vec4 point = State(from.positions).at[root + i];
    return point.w == 0.0;
}

vec4 orientationAt(uint i) {
    if (i > 0) return loadVector(rod.motion, orientationIndex(i));
    return multiply(
        root_frame.rotation,
        segmentRow(rod.segments, 0, kRodHalfRotation, guides.strand_count, strand));
}

// Drag on a vertex with this motion: the tangent, and dragFactor(). Call it before the prediction
// turns the segment that ends there, or the segment below.
vec4 dragAt(uint i, RodMotion motion) {
    vec3 tangent = axisOf(motion.orientation);
    if (i + 1 < guides.vertices_per_strand)
        tangent = tangentBetween(tangent, axisOf(orientationAt(i + 1)));
    vec3 air = Vectors(push.air).at[root + i].xyz;
    vec3 u = air - unit / guides.step.sub * motion.velocity;
    return vec4(tangent, dragFactor(push.drag, tangent, u, guides.step.sub));
}

// Moves a vertex out of bodies from `free`. `pushed` is its displacement from there, in the
// strand's unit. `contact` is 1 from the first vertex on that touches a body. `met`: its contact.
vec3 collideVertex(
    uint i, vec3 free, vec3 before, inout float contact, inout vec3 pushed,
    out VertexContact met) {
    vec3 held = pushOutOfBodies(
        free, before, bodiesAt(guides, root + i), push.frame, push.frame_before, met);
    if (met.held != kTouchesNone) {
        contact = 1.0;
        pushed = (held - free) / unit;
    }
    return held;
}

// Returns false for an invocation without a strand.
bool takeStrand() {
    guides = GuideReference(push.guides).parameters;
    from = GuideReference(push.from).parameters;
    rod = RodReference(push.solver).parameters;
    uint lane = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    strand = push.first_strand + lane;
    if (lane >= rod.most_strands || strand >= guides.strand_count) return false;

    root = strand * guides.vertices_per_strand;
    unit = Factors(rod.units).at[strand];
    root_frame = rootFrame(push.frame, push.roots, strand);
    root_frame_before = rootFrame(push.frame_before, push.roots_before, strand);
    return true;
}

#endif
