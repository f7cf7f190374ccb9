#ifndef HAIRBENCH_CONSTRAINT_LOCAL_GLSL
#define HAIRBENCH_CONSTRAINT_LOCAL_GLSL

// Pull a segment from a to b toward its rest edge in the frame of the segment before it, thesis eq.
// 11; Han and Harada 2012, Real-time Hair Simulation with Efficient Hair Style Preservation. w are
// inverse masses; a pinned end leaves the whole correction to the other.
void pullToShape(inout vec4 a, inout vec4 b, vec3 goal_edge, float stiffness) {
    float mass = a.w + b.w;
    if (mass == 0.0) return;  // both pinned
    vec3 correction = (stiffness / mass) * (a.xyz + goal_edge - b.xyz);
    a.xyz -= a.w * correction;
    b.xyz += b.w * correction;
}

#endif
