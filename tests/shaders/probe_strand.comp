#version 460
// Shades points of strands with the model that the pipeline is specialized for, without shadows.
// One invocation per point.
#extension GL_GOOGLE_include_directive : require

#include "probes.glsl"
#include "common/picture.glsl"

// Replaces shading/shadows.glsl, because a probe does not have its images.
#define HAIRBENCH_SHADOWS_GLSL
#include "shading/lights.glsl"
struct Receiver {
    vec3 position;
    vec3 normal;
    vec3 tangent;
    float width;
    vec3 transmittance;
};
LightPath lightPath(PictureParameters picture, uint light, Receiver receiver) { return kFreePath; }
vec3 surfaceTransmittance(PictureParameters picture) { return vec3(0.0); }
vec3 visibility(LightPath path) { return vec3(path.meshes); }

#include "shading/strand_shading.glsl"

layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push { ProbeStrandPush push; };

layout(buffer_reference, scalar) buffer Probes { StrandProbe at[]; };

void main() {
    uint index = gl_WorkGroupID.x * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= push.count) return;  // no barrier follows

    PictureParameters picture = PictureReference(push.picture).parameters;
    StrandProbe probe = Probes(push.probes).at[index];
    StrandFragment fragment =
        StrandFragment(vec3(0.0), probe.tangent, probe.to_eye, probe.across, 0.5, 1e-4, 1e-4,
                       1.0);
    probe.normal = cylinderNormal(fragment);
    probe.color = shadeStrand(picture, fragment, vec3(1.0));
    Probes(push.probes).at[index] = probe;
}
