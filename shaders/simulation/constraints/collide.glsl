#ifndef HAIRBENCH_CONSTRAINT_COLLIDE_GLSL
#define HAIRBENCH_CONSTRAINT_COLLIDE_GLSL

#include "common/quaternion.glsl"
#include "shared/simulation_structs.h"

// The nearest point that is not inside the capsule. From a point on its axis that is sideways,
// along perpendicular(axis).
vec3 pushOut(vec3 position, Capsule capsule) {
    vec3 axis = capsule.b - capsule.a;
    float size = dot(axis, axis);
    float along = size > 0.0 ? clamp(dot(position - capsule.a, axis) / size, 0.0, 1.0) : 0.0;
    vec3 nearest = capsule.a + along * axis;
    vec3 outward = position - nearest;
    float depth = length(outward);
    if (depth >= capsule.radius) return position;
    vec3 normal = depth < kShortestSegment ? perpendicular(axis) : outward / depth;
    return nearest + capsule.radius * normal;
}

#endif
