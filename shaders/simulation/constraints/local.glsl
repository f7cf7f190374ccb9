#ifndef HAIRBENCH_CONSTRAINT_LOCAL_GLSL
#define HAIRBENCH_CONSTRAINT_LOCAL_GLSL

// Pulls a segment from a to b towards its rest edge in the frame of the segment before it: thesis
// eq. 11; Han and Harada 2012, Real-time Hair Simulation with Efficient Hair Style Preservation. w
// are inverse masses. If one end is pinned, the other takes the whole correction. An end that air
// makes heavier moves proportionally less.
void pullToShape(inout vec4 a, inout vec4 b, vec3 goal_edge, float stiffness) {
    float free_ends = sign(a.w) + sign(b.w);
    if (free_ends == 0.0) return;  // both pinned
    vec3 correction = (stiffness / free_ends) * (a.xyz + goal_edge - b.xyz);
    a.xyz -= a.w * correction;
    b.xyz += b.w * correction;
}

#endif
