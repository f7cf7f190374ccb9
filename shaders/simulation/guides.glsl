// The guides and a substep's push constants, for every solver.
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

// Groups are counted row by row: more of them may be needed than fit in one row.
uint workgroupIndex() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }

#endif
