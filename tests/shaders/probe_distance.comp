#version 460
// Evaluates a field and the contact with it at points that the host chooses. One invocation per
// point.
#extension GL_GOOGLE_include_directive : require

#include "probes.glsl"
#include "simulation/constraints/distance_field.glsl"
#include "simulation/constraints/friction.glsl"

layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push { ProbeDistancePush push; };

layout(buffer_reference, scalar) buffer Probes { DistanceProbe at[]; };

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint index = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= push.count) return;  // no barrier follows

    DistanceProbe probe = Probes(push.probes).at[index];
    probe.distance = sampleDistance(push.field, probe.position, probe.gradient);
    vec3 normal;
    float share;
    float gap = gapTo(push.field, push.margin, probe.position, normal);
    probe.pushed = probe.position;
    if (gap < 0.0)
        probe.pushed = slideBack(
            probe.position - gap * normal, probe.before, normal, -gap, push.friction,
            share);
    Probes(push.probes).at[index] = probe;
}
