#ifndef HAIRBENCH_CONSTRAINT_FRICTION_GLSL
#define HAIRBENCH_CONSTRAINT_FRICTION_GLSL

// Takes back what a vertex moved along a surface since `before`, at most the friction coefficient
// times the depth that it was pushed out of: Macklin et al. 2014, Unified particle physics for
// real-time applications, eq. 24. `surface` is where it was pushed to, along the unit `normal`.
// Sets `share` to the share of it that is taken back; 1: the vertex sticks.
vec3 slideBack(
    vec3 surface, vec3 before, vec3 normal, float depth, float friction, out float share) {
    vec3 moved = surface - before;
    vec3 slid = moved - dot(moved, normal) * normal;
    float held = friction * depth;
    float slid_length = length(slid);
    share = slid_length > held ? held / slid_length : 1.0;
    return surface - share * slid;
}

#endif
