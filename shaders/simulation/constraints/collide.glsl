#ifndef HAIRBENCH_CONSTRAINT_COLLIDE_GLSL
#define HAIRBENCH_CONSTRAINT_COLLIDE_GLSL

#include "common/quaternion.glsl"
#include "shared/simulation_structs.h"

// The nearest point that is the margin away from the capsule; from a point on its axis sideways, along
// perpendicular(axis). Friction then takes back what the vertex moved along the surface since `before`, at
// most the coefficient times the depth: Macklin et al. 2014, Unified particle physics for real-time
// applications, eq. 24.
vec3 pushOut(vec3 position, vec3 before, Capsule capsule, float margin, float friction) {
    vec3 axis = capsule.b - capsule.a;
    float size = dot(axis, axis);
    float along = size > 0.0 ? clamp(dot(position - capsule.a, axis) / size, 0.0, 1.0) : 0.0;
    vec3 nearest = capsule.a + along * axis;
    vec3 outward = position - nearest;
    float from_axis = length(outward);
    float radius = capsule.radius + margin;
    if (from_axis >= radius) return position;
    vec3 normal = from_axis < kShortestSegment ? perpendicular(axis) : outward / from_axis;
    vec3 surface = nearest + radius * normal;

    vec3 moved = surface - before;
    vec3 slid = moved - dot(moved, normal) * normal;
    float held = friction * (radius - from_axis);
    float slid_length = length(slid);
    return slid_length > held ? surface - held / slid_length * slid : surface - slid;
}

#endif
