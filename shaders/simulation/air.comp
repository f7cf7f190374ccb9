#version 460
// Computes the velocity of the air at every guide vertex. The solvers use it for drag across the
// hair in each of their substeps: air_drag.glsl. The drag along the hair is an acceleration of the
// whole time step: forces.h. One invocation per vertex.
#extension GL_GOOGLE_include_directive : require

#include "simulation/air_drag.glsl"
#include "simulation/guides.glsl"
#include "simulation/turbulence.glsl"

layout(local_size_x = kGuideGroupSize) in;

layout(push_constant, scalar) uniform Push { AirPush push; };

// The acceleration of a vertex by the drag along the hair, m/s^2.
vec3 dragAlong(GuideParameters guides, uint index, vec3 air) {
    vec3 tangent = tangentAt(guides, index);
    vec3 position = Vectors(guides.positions).at[index].xyz;
    vec3 velocity = (position - Vectors(guides.previous).at[index].xyz) / guides.step.sub;
    return push.drag_along * dot(tangent, air - velocity) * tangent;
}

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
    State(push.accelerations).at[index] =
        vec4(push.drag_along > 0.0 ? dragAlong(guides, index, air) : vec3(0.0), 0.0);
}
