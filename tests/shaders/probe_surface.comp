#version 460
// Evaluates the reflection of surfaces for directions that the host chooses. One invocation per
// probe.
#extension GL_GOOGLE_include_directive : require

#include "probes.glsl"
#include "shading/surface_brdf.glsl"

layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push { SurfaceProbePush push; };

layout(buffer_reference, scalar) buffer Probes { SurfaceProbe at[]; };

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint index = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= push.count) return;  // no barrier follows

    SurfaceProbe probe = Probes(push.probes).at[index];
    Surface surface = Surface(probe.base_color, probe.metallic, probe.roughness);
    probe.f = surfaceBrdf(surface, probe.normal, probe.to_eye, probe.to_light);
    Probes(push.probes).at[index] = probe;
}
