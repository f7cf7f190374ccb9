#ifndef HAIRBENCH_SIMULATION_CONTACTS_GLSL
#define HAIRBENCH_SIMULATION_CONTACTS_GLSL

#include "simulation/constraints/bodies.glsl"
#include "simulation/guides.glsl"

// Pushes successive vertices of a strand, [first, end), out of bodies and marks contact. The
// invocation has stored their positions, and in `previous` those before the substep. Returns 1
// where any touched a body, else 0. A plain loop: collisions are too long to unroll, and come once
// in a substep.
float collide(
    GuideParameters guides, RigidFrame frame, RigidFrame frame_before, uint first, uint end) {
    float contact = 0.0;
    for (uint i = first; i < end; ++i) {
        vec4 point = State(guides.positions).at[i];
        vec3 before = State(guides.previous).at[i].xyz;
        bool touched = false;
        if (point.w > 0.0)
            point.xyz = pushOutOfBodies(
                point.xyz, before, guides.bodies, frame, frame_before, touched);
        if (touched) contact = 1.0;
        State(guides.positions).at[i] = point;
        State(guides.previous).at[i].w = contact;
    }
    return contact;
}

#endif
