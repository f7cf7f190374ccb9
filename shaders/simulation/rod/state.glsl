// The `rod` solver's memory, and rotations of segments.
#ifndef HAIRBENCH_SIMULATION_ROD_STATE_GLSL
#define HAIRBENCH_SIMULATION_ROD_STATE_GLSL

#include "common/quaternion.glsl"
#include "shared/rod_structs.h"
#include "simulation/guides.glsl"

layout(buffer_reference, scalar) readonly buffer RodReference { RodParameters parameters; };
layout(buffer_reference, scalar) readonly buffer RodSegments { RodSegment at[]; };
layout(buffer_reference, scalar) buffer RodMotions { RodMotion at[]; };

// The third axis of the frame that a unit quaternion turns to.
vec3 axisOf(vec4 q) {
    return vec3(
        2.0 * (q.x * q.z + q.w * q.y), 2.0 * (q.y * q.z - q.w * q.x),
        q.w * q.w + q.z * q.z - q.x * q.x - q.y * q.y);
}

// The rotation as a matrix, whose columns are the three axes.
mat3 matrixOf(vec4 q) {
    return mat3(
        q.w * q.w + q.x * q.x - q.y * q.y - q.z * q.z, 2.0 * (q.x * q.y + q.w * q.z),
        2.0 * (q.x * q.z - q.w * q.y), 2.0 * (q.x * q.y - q.w * q.z),
        q.w * q.w + q.y * q.y - q.x * q.x - q.z * q.z, 2.0 * (q.y * q.z + q.w * q.x), axisOf(q));
}

// The orientation turned by a rotation vector, to second order; by less than half a turn however
// long it is.
vec4 turned(vec4 orientation, vec3 rotation) {
    return normalize(multiply(vec4(0.5 * rotation, 1.0), orientation));
}

// What turned() adds to a vector: exact where the difference of the two would be rounding.
vec3 gainOf(vec3 v, vec3 rotation) {
    vec3 t = 0.5 * rotation;
    vec3 swept = cross(t, v);
    return 2.0 / (1.0 + dot(t, t)) * (swept + cross(t, swept));
}

#endif
