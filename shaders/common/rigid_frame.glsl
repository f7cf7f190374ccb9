#ifndef HAIRBENCH_COMMON_RIGID_FRAME_GLSL
#define HAIRBENCH_COMMON_RIGID_FRAME_GLSL

#extension GL_GOOGLE_include_directive : require

#include "common/extensions.glsl"
#include "common/quaternion.glsl"
#include "shared/distance_field_structs.h"
#include "shared/simulation_structs.h"

vec3 toWorld(RigidFrame frame, vec3 point) {
    return rotate(frame.rotation, point) + frame.translation;
}

vec3 fromWorld(RigidFrame frame, vec3 point) {
    return rotate(conjugate(frame.rotation), point - frame.translation);
}

#endif
