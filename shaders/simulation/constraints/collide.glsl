#ifndef HAIRBENCH_CONSTRAINT_COLLIDE_GLSL
#define HAIRBENCH_CONSTRAINT_COLLIDE_GLSL

#include "common/quaternion.glsl"
#include "shared/distance_field_structs.h"
#include "shared/simulation_structs.h"
#include "simulation/constraints/friction.glsl"

// The nearest point that is the margin away from the capsule; from a point on its axis sideways,
// along perpendicular(axis). Friction holds it where it was `before`.
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
    return slideBack(nearest + radius * normal, before, normal, radius - from_axis, friction);
}

#endif
