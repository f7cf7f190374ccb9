#version 460
// Finds where rays enter and leave round pieces of strands that the host chooses. One invocation per
// probe.
#extension GL_GOOGLE_include_directive : require

#include "probes.glsl"
#include "strands/rays/round_cone.glsl"

layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push { RoundConeProbePush push; };

layout(buffer_reference, scalar) buffer Probes { RoundConeProbe at[]; };

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint index = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= push.count) return;  // no barrier follows

    RoundConeProbe probe = Probes(push.probes).at[index];
    RayChord chord =
        chordOf(probe.origin, probe.direction,
                RoundCone(probe.from, probe.to, probe.from_radius, probe.to_radius));
    probe.enters = chord.enters;
    probe.leaves = chord.leaves;
    Probes(push.probes).at[index] = probe;
}
