#version 460
// Moves rest positions, and a solver's goals, to a place in a cache: hair/simulation/cache.h. One
// invocation per vertex.
#extension GL_GOOGLE_include_directive : require

#include "simulation/cache.glsl"

layout(local_size_x = kGuideGroupSize) in;

layout(push_constant, scalar) uniform Push { CacheRestPush push; };

void main() {
    uint vertex = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (vertex >= push.vertex_count) return;  // no barrier follows

    vec3 rest = cachedAt(push.place, vertex);
    State(push.rest_positions).at[vertex].xyz = rest;
    if (push.goals == kNoAddress) return;
    vec4 offset = Vectors(push.goal_offsets).at[vertex];
    State(push.goals).at[vertex] = vec4(rest + offset.xyz, offset.w);
}
