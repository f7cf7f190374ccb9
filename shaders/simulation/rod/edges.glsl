// Rods with segments that stretch and shear, so that vertices and orientations move independently.
// Until finish(), the residuals of the strand are whole edges at the start of the substep. Define
// kScratchRows and kMoved, the row of a vertex's displacement in the substep, first.
#ifndef HAIRBENCH_SIMULATION_ROD_EDGES_GLSL
#define HAIRBENCH_SIMULATION_ROD_EDGES_GLSL

#include "simulation/rod/strand.glsl"

const float kMostSpring = 1.0e15;  // rigid compared with any mass; its square is a float

vec3 root_moved;
float stretching;  // stiffness against stretch and shear

uint edgeIndex(uint i) { return motionIndex(i, kRodResidual, guides.strand_count, strand); }

// A segment's edge at the start of the substep.
vec3 edgeAt(uint i) { return loadVector(rod.motion, edgeIndex(i)).xyz; }

// Moves the root with its follicle.
void takeRoot() {
    stretching = min(rod.stretching / (unit * unit), kMostSpring);
    root_now = toWorld(root_frame, Vectors(guides.rest_positions).at[root].xyz);
    vec4 follicle = State(from.positions).at[root];
    root_moved = (root_now - follicle.xyz) / unit;
    State(guides.previous).at[root] = vec4(follicle.xyz, 0.0);
    State(guides.positions).at[root] = vec4(root_now, follicle.w);
}

// The displacement of a vertex by everything except the forces of the strand. Time is counted in
// substeps, so a velocity is also a displacement. `drag`: drag as from dragAt(), 0 if the vertex
// is pinned. Adds the segment's edge to `edges`, the sum from the root to here.
vec3 predictedMove(uint i, RodMotion motion, inout vec3 edges, out vec4 drag) {
    vec3 acceleration = guides.gravity;
    if (push.accelerations != kNoAddress) acceleration += Vectors(push.accelerations).at[root + i].xyz;
    float scale = guides.step.sub * guides.step.sub / unit;
    vec3 moved = guides.velocity_kept * motion.velocity + scale * acceleration;
    drag = vec4(0.0);
    if (push.air != kNoAddress) {
        drag = dragAt(i, motion);
        vec3 air = guides.step.sub / unit * Vectors(push.air).at[root + i].xyz;
        moved = withDrag(moved, air, drag.xyz, drag.w);
    }
    vec3 edge = restLength(i) * axisOf(motion.orientation) + motion.residual;
    storeVector(rod.motion, edgeIndex(i), vec4(edge, 0.0));
    edges += edge;
    if (isPinned(i)) {
        vec3 follicle = root_now - unit * root_moved;
        moved = (State(from.positions).at[root + i].xyz - follicle) / unit - edges;
        drag = vec4(0.0);
    }
    return moved;
}

// Updates velocities and positions, and collides, which leaves residuals.
void finish() {
    State positions = State(guides.positions);
    vec3 moved_above = root_moved;
    vec3 pushed_above = vec3(0.0);
    vec3 edges = vec3(0.0);  // from the root to here, without collisions
    float contact = 0.0;     // 1 from the first vertex that touches a body
    for (uint i = 1; i < guides.vertices_per_strand; ++i) {
        RodMotion motion = motionAt(i);
        vec3 moved = scratchAt(i, kMoved).xyz;
        vec3 edge = motion.residual + (moved - moved_above);
        edges += edge;
        vec4 point = State(from.positions).at[root + i];
        vec3 before = point.xyz;
        vec3 pushed = vec3(0.0);
        motion.velocity = vec3(0.0);
        if (!isPinned(i)) {
            vec3 free = root_now + unit * edges;
            VertexContact met;
            vec3 held = collideVertex(i, free, before, contact, pushed, met);
            motion.velocity = moved + pushed;
            point.xyz = held;
        }
        positions.at[root + i] = point;
        motion.residual = edge + (pushed - pushed_above) -
                        restLength(i) * axisOf(motion.orientation);
        setMotion(i, motion);
        State(guides.previous).at[root + i] = vec4(before, contact);
        moved_above = moved;
        pushed_above = pushed;
    }
}

#endif
