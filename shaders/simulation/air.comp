#version 460
// Computes the velocity of the air at every guide vertex. The solvers use it for drag in each of
// their substeps: air_drag.glsl. One invocation per vertex.
#extension GL_GOOGLE_include_directive : require

#include "simulation/guides.glsl"
#include "simulation/turbulence.glsl"

layout(local_size_x = kGuideGroupSize) in;

layout(push_constant, scalar) uniform Push { AirPush push; };

void main() {
    GuideParameters guides = GuideReference(push.guides).parameters;
    uint index = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= guides.strand_count * guides.vertices_per_strand) return;  // no barrier follows

    vec3 air = push.mean_wind;
    if (push.fluctuation > 0.0) {
        vec3 position = Vectors(guides.positions).at[index].xyz;
        air += push.fluctuation *
               turbulence(
                   push.cell, push.cells_per_metre * position + push.fraction, push.octaves,
                   guides.seed);
    }
    State(push.air).at[index] = vec4(air, 0.0);
    State(push.accelerations).at[index] = vec4(0.0);
}
