#ifndef HAIRBENCH_SIMULATION_CONTACTS_GLSL
#define HAIRBENCH_SIMULATION_CONTACTS_GLSL

#include "simulation/constraints/bodies.glsl"
#include "simulation/guides.glsl"

// Moves a vertex of a strand out of bodies and marks contact. `contact` is 1 if any vertex above
// touched a body, else 0. The invocation has already stored the vertex's position, and in
// `previous` the position before the substep.
VertexContact collide(
    GuideParameters guides, RigidFrame frame, RigidFrame frame_before, uint vertex,
    inout float contact) {
    vec4 point = State(guides.positions).at[vertex];
    vec3 before = State(guides.previous).at[vertex].xyz;
    VertexContact met = VertexContact(vec4(0.0), kTouchesNone);
    if (point.w > 0.0)
        point.xyz = pushOutOfBodies(
            point.xyz, before, bodiesAt(guides, vertex), frame, frame_before, met);
    if (met.held != kTouchesNone) contact = 1.0;
    State(guides.positions).at[vertex] = point;
    State(guides.previous).at[vertex].w = contact;
    return met;
}

#endif
