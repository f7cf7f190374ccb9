#ifndef HAIRBENCH_CONSTRAINT_COLLIDE_GLSL
#define HAIRBENCH_CONSTRAINT_COLLIDE_GLSL

#include "common/extensions.glsl"
#include "common/quaternion.glsl"
#include "shared/distance_field_structs.h"
#include "shared/simulation_structs.h"

layout(buffer_reference, scalar) readonly buffer Capsules { Capsule at[]; };

// Distance of a point from the capsule with its margin; negative inside. `normal`: the unit vector
// away from the axis; perpendicular(axis) for a point on the axis.
float gapTo(Capsule capsule, float margin, vec3 position, out vec3 normal) {
    vec3 axis = capsule.b - capsule.a;
    float size = dot(axis, axis);
    float along = size > 0.0 ? clamp(dot(position - capsule.a, axis) / size, 0.0, 1.0) : 0.0;
    precise vec3 outward = position - (capsule.a + along * axis);  // strands/curve.glsl
    float from_axis = length(outward);
    normal = from_axis < kShortestSegment ? perpendicular(axis) : outward / from_axis;
    return from_axis - capsule.radius - margin;
}

#endif
