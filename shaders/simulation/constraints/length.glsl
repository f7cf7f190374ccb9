#ifndef HAIRBENCH_CONSTRAINT_LENGTH_GLSL
#define HAIRBENCH_CONSTRAINT_LENGTH_GLSL

#include "shared/distance_field_structs.h"
#include "shared/simulation_structs.h"

// Distance projection, thesis eq. 12; Mueller et al. 2007, Position Based Dynamics.
// w are inverse masses. Points that coincide are parted along +y.
void projectLength(inout vec4 a, inout vec4 b, float rest_length) {
    float mass = a.w + b.w;
    if (mass == 0.0) return;  // both pinned
    vec3 edge = b.xyz - a.xyz;
    float len = length(edge);
    vec3 direction = len < kShortestSegment ? vec3(0.0, 1.0, 0.0) : edge / len;
    vec3 correction = ((len - rest_length) / mass) * direction;
    a.xyz += a.w * correction;
    b.xyz -= b.w * correction;
}

#endif
