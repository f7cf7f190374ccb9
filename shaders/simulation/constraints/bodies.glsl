#ifndef HAIRBENCH_CONSTRAINT_BODIES_GLSL
#define HAIRBENCH_CONSTRAINT_BODIES_GLSL

#include "common/rigid_frame.glsl"
#include "simulation/constraints/collide.glsl"
#include "simulation/constraints/distance_field.glsl"
#include "simulation/guides.glsl"

layout(buffer_reference, scalar) readonly buffer Capsules { Capsule at[]; };
layout(buffer_reference, scalar) readonly buffer BodyFields { BodyField at[]; };

// A vertex in the world and as the head sees it, now and at the start of the substep.
struct MovingVertex {
    vec3 position;
    vec3 before;
    vec3 position_on_head;
    vec3 before_on_head;
};

void move(inout MovingVertex vertex, vec3 pushed, bool on_head, RigidFrame frame) {
    vertex.position = on_head ? toWorld(frame, pushed) : pushed;
    vertex.position_on_head = on_head ? pushed : fromWorld(frame, pushed);
}

// Pushes a vertex out of every body, one after the other, and lets it slide on them. Contact is
// resolved in the body's own frame, so that what slides is the motion relative to the body.
// `before` is where the vertex was at the start of the substep. Sets `touched` where a body pushed.
vec3 pushOutOfBodies(
    vec3 position, vec3 before, Bodies bodies, RigidFrame frame, RigidFrame frame_before,
    inout bool touched) {
    MovingVertex vertex = MovingVertex(
        position, before, fromWorld(frame, position), fromWorld(frame_before, before));
    for (uint i = 0; i < bodies.capsule_count; ++i) {
        Capsule capsule = Capsules(bodies.capsules).at[i];
        bool on_head = capsule.follows == kFollowsHead;
        vec3 here = on_head ? vertex.position_on_head : vertex.position;
        vec3 there = on_head ? vertex.before_on_head : vertex.before;
        vec3 pushed = pushOut(here, there, capsule, bodies.margin, bodies.friction);
        if (pushed != here) {
            touched = true;
            move(vertex, pushed, on_head, frame);
        }
    }
    for (uint i = 0; i < bodies.field_count; ++i) {
        BodyField body = BodyFields(bodies.fields).at[i];
        bool on_head = body.follows == kFollowsHead;
        vec3 here = on_head ? vertex.position_on_head : vertex.position;
        vec3 there = on_head ? vertex.before_on_head : vertex.before;
        vec3 pushed = pushOut(here, there, body.field, bodies.margin, bodies.friction);
        if (pushed != here) {
            touched = true;
            move(vertex, pushed, on_head, frame);
        }
    }
    return vertex.position;
}

#endif
