// The guides and the push constants of a substep, for every solver.
#ifndef HAIRBENCH_SIMULATION_GUIDES_GLSL
#define HAIRBENCH_SIMULATION_GUIDES_GLSL

#extension GL_GOOGLE_include_directive : require

#include "common/extensions.glsl"
#include "shared/distance_field_structs.h"
#include "shared/simulation_structs.h"

layout(buffer_reference, scalar) readonly buffer GuideReference { GuideParameters parameters; };
layout(buffer_reference, scalar) buffer State { vec4 at[]; };
layout(buffer_reference, scalar) readonly buffer Vectors { vec4 at[]; };
layout(buffer_reference, scalar) readonly buffer Factors { float at[]; };

// Work groups are counted row by row, because one row may be too short for them.
uint workgroupIndex() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }

// Verlet integration without velocities, thesis eq. 9, with damping.
vec3 integrate(
    vec3 position, vec3 previous, vec3 acceleration, float velocity_kept, float substep_squared) {
    return position + velocity_kept * (position - previous) + acceleration * substep_squared;
}

#endif
