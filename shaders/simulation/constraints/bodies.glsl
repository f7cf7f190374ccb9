#ifndef HAIRBENCH_CONSTRAINT_BODIES_GLSL
#define HAIRBENCH_CONSTRAINT_BODIES_GLSL

#include "common/rigid_frame.glsl"
#include "simulation/constraints/collide.glsl"
#include "simulation/constraints/distance_field.glsl"
#include "simulation/constraints/friction.glsl"
#include "simulation/guides.glsl"

const float kFar = 1.0e9;  // m

const float kTouchesNone = -1.0;

// What a vertex has met. `plane`: the tangent plane of the last body that it touches, otherwise of
// the nearest: dot(plane.xyz, x) >= plane.w outside; 0 where there is no body.
struct Met {
    vec4 plane;
    float held;  // share of its motion along the body that friction takes back, or kTouchesNone
};

// A vertex in the world and as the head sees it, now and at the start of the substep, and what it
// has met.
struct MovingVertex {
    vec3 position;
    vec3 before;
    vec3 position_on_head;
    vec3 before_on_head;
    vec4 plane;
    float gap;  // to it; 0 where it touches
    float share;  // that friction takes back of its motion along the body
};

// A body `gap` away from the vertex, negative inside, in its own frame. Takes the vertex out the
// shortest way and lets it slide on the body: what slides is the motion relative to it.
void meet(
    inout MovingVertex vertex, float gap, vec3 normal, float friction, bool on_head,
    RigidFrame frame) {
    if (gap >= vertex.gap) return;
    vec3 outward = on_head ? rotate(frame.rotation, normal) : normal;
    vertex.plane = vec4(outward, dot(outward, vertex.position) - gap);
    vertex.gap = max(gap, 0.0);
    if (gap >= 0.0) return;
    vec3 here = on_head ? vertex.position_on_head : vertex.position;
    vec3 there = on_head ? vertex.before_on_head : vertex.before;
    vec3 pushed = slideBack(here - gap * normal, there, normal, -gap, friction, vertex.share);
    vertex.position = on_head ? toWorld(frame, pushed) : pushed;
    vertex.position_on_head = on_head ? pushed : fromWorld(frame, pushed);
}

// The bodies as a vertex of [strand][vertex] meets them, which may keep less of their margin.
Bodies bodiesAt(GuideParameters guides, uint vertex) {
    // Mesa 22's llvmpipe reads x where the last component alone is read: hence the whole vector.
    vec4 rest = Vectors(guides.rest_positions).at[vertex];
    Bodies bodies = guides.bodies;
    bodies.margin = rest.w;
    return bodies;
}

// Takes a vertex out of every body, one after the other. `before` is where it was at the start of
// the substep. Returns where it is then.
vec3 pushOutOfBodies(
    vec3 position, vec3 before, Bodies bodies, RigidFrame frame, RigidFrame frame_before,
    out Met met) {
    MovingVertex vertex = MovingVertex(
        position, before, fromWorld(frame, position), fromWorld(frame_before, before), vec4(0.0),
        kFar, 0.0);
    vec3 normal;
    for (uint i = 0; i < bodies.capsule_count; ++i) {
        Capsule capsule = Capsules(bodies.capsules).at[i];
        bool on_head = capsule.follows == kFollowsHead;
        vec3 here = on_head ? vertex.position_on_head : vertex.position;
        float gap = gapTo(capsule, bodies.margin, here, normal);
        meet(vertex, gap, normal, bodies.friction, on_head, frame);
    }
    for (uint i = 0; i < bodies.field_count; ++i) {
        BodyField body = BodyFields(bodies.fields).at[i];
        bool on_head = body.follows == kFollowsHead;
        vec3 here = on_head ? vertex.position_on_head : vertex.position;
        float gap = gapTo(body.field, bodies.margin, here, normal);
        meet(vertex, gap, normal, bodies.friction, on_head, frame);
    }
    met = Met(vertex.plane, vertex.gap > 0.0 ? kTouchesNone : vertex.share);
    return vertex.position;
}

#endif
