#version 460
// One substep of hair that is frozen at rest, which a cache may move: the head carries every vertex. One invocation per
// vertex.
#extension GL_GOOGLE_include_directive : require

#include "common/rigid_frame.glsl"
#include "simulation/guides.glsl"
#include "simulation/root_frame.glsl"

layout(local_size_x = kGuideGroupSize) in;

layout(push_constant, scalar) uniform Push { SubstepPush push; };

void main() {
    GuideParameters guides = GuideReference(push.guides).parameters;
    uint index = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= guides.strand_count * guides.vertices_per_strand) return;  // no barrier follows

    vec4 point = State(GuideReference(push.from).parameters.positions).at[index];
    State(guides.previous).at[index] = vec4(point.xyz, 0.0);
    bool pinned = index % guides.vertices_per_strand != 0u && point.w == 0.0;
    vec3 rest = Vectors(guides.rest_positions).at[index].xyz;
    uint strand = index / guides.vertices_per_strand;
    if (!pinned) point.xyz = toWorld(rootFrame(push.frame, push.roots, strand), rest);
    State(guides.positions).at[index] = point;
}
