#version 460
// Guides between two steps, for drawing. One invocation per vertex.
#extension GL_GOOGLE_include_directive : require

#include "simulation/guides.glsl"

layout(local_size_x = kGuideGroupSize) in;

layout(push_constant, scalar) uniform Push { InterpolatePush push; };

void main() {
    uint index = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= push.vertex_count) return;
    vec4 from = Vectors(push.from).at[index];
    vec4 to = Vectors(push.to).at[index];
    State(push.drawn).at[index] = vec4(mix(from.xyz, to.xyz, push.share), to.w);
}
