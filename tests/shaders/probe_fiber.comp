#version 460
// Evaluates the scattering of a fibre for directions that the host chooses. One invocation per
// probe.
#extension GL_GOOGLE_include_directive : require

#include "probes.glsl"
#include "shading/dual_scattering.glsl"

layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push { ProbeFiberPush push; };

layout(buffer_reference, scalar) buffer Probes { FiberProbe at[]; };

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint index = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= push.count) return;  // no barrier follows

    HairOptics optics = HairOpticsReference(push.optics).optics;
    FiberProbe probe = Probes(push.probes).at[index];
    float cos_i = sqrt(max(1.0 - probe.to_light.x * probe.to_light.x, 0.0));
    probe.bsdf = fiberBsdf(optics, probe.to_eye, probe.to_light, probe.h) * cos_i;
    if (optics.averages != kNoAddress) {
        LightPath path =
            poissonPath(kFreePath, probe.strands, forwardScattering(optics, probe.to_light));
        path.ended = vec3(probe.ended);
        path.returned = vec3(probe.returned);
        FiberView view = fiberView(optics, probe.to_eye, probe.h);
        probe.dual_scattering =
            dualScattering(optics, view, probe.to_eye, probe.to_light, path);
    }
    Probes(push.probes).at[index] = probe;
}
