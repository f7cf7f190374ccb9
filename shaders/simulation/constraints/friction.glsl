#ifndef HAIRBENCH_CONSTRAINT_FRICTION_GLSL
#define HAIRBENCH_CONSTRAINT_FRICTION_GLSL

// Reverses a vertex's motion along a surface since `before`, at most by the friction coefficient
// times the penetration depth: Macklin et al. 2014, Unified particle physics for real-time
// applications, eq. 24. `surface` is its position after it was pushed out along the unit `normal`.
// Sets `share` to the reversed share of the motion; 1: the vertex sticks.
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
