#version 460
// Adds to every guide vertex its part of the acceleration of the vertex that a hand holds:
// hair/simulation/forces.h. One invocation per vertex. As with the wind, roots get nothing.
#extension GL_GOOGLE_include_directive : require

#include "simulation/guides.glsl"

layout(local_size_x = kGuideGroupSize) in;

layout(push_constant, scalar) uniform Push { PullPush push; };

// 1 at the held vertex, falling to 1/e at `radius` from it.
float partAt(float distance_at_rest, float radius) {
    if (radius < kShortestSegment) return 0.0;
    float along = distance_at_rest / radius;
    return exp(-along * along);
}

void main() {
    GuideParameters guides = GuideReference(push.guides).parameters;
    uint index = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= guides.strand_count * guides.vertices_per_strand) return;  // no barrier follows
    if (index % guides.vertices_per_strand == 0) return;

    Vectors rest = Vectors(guides.rest_positions);
    float part = 1.0;
    if (index != push.held_vertex)
        part = partAt(distance(rest.at[index].xyz, rest.at[push.held_vertex].xyz), push.radius);
    State(push.accelerations).at[index].xyz += part * Vectors(push.held).at[0].xyz;
}
