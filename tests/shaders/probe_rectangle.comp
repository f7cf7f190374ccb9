#version 460
// Evaluates the reflection of rectangular lights by surfaces at the origin. One invocation per
// probe.
#extension GL_GOOGLE_include_directive : require

#include "probes.glsl"
#include "shading/surface_brdf.glsl"

layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push { RectangleProbePush push; };

layout(buffer_reference, scalar) buffer Probes { RectangleProbe at[]; };

void main() {
    uint index = gl_WorkGroupID.x * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= push.count) return;  // no barrier follows

    RectangleProbe probe = Probes(push.probes).at[index];
    Surface surface = Surface(probe.base_color, probe.metallic, probe.roughness);
    mat4x3 corners =
        mat4x3(probe.corners[0], probe.corners[1], probe.corners[2], probe.corners[3]);
    vec3 whole = vectorIrradiance(wholeRectangle(corners));
    RectangleReflection reflected =
        rectangleBrdf(surface, probe.normal, probe.to_eye, normalize(whole), corners);
    vec3 before = vectorIrradiance(clipToHorizon(corners, probe.normal));
    probe.diffuse = reflected.diffuse * dot(before, probe.normal);
    probe.glossy = reflected.glossy;
    Probes(push.probes).at[index] = probe;
}
