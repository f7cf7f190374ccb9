#version 460
// Evaluates lights and shading models at points that the host chooses. One invocation per point.
#extension GL_GOOGLE_include_directive : require

#include "probes.glsl"
#include "shading/kajiya_kay.glsl"
#include "shading/lights.glsl"
#include "shading/phong.glsl"

layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push { ProbeModelsPush push; };

layout(buffer_reference, scalar) buffer Probes { ModelProbe at[]; };

void main() {
    uint index = gl_WorkGroupID.x * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= push.count) return;  // no barrier follows

    ModelProbe probe = Probes(push.probes).at[index];
    LightSample light = lightAt(Lights(push.lights).lights[probe.light], probe.position);
    probe.to_light = light.to_light;
    probe.color = light.color;
    probe.angular_radius = light.angular_radius;
    probe.matt = mattResponse(light, probe.normal);
    probe.widened_exponent = widenedExponent(light, probe.exponent);
    PhongLight surface = phong(probe.normal, light.to_light, probe.to_eye, probe.exponent);
    probe.phong_diffuse = surface.diffuse;
    probe.phong_specular = surface.specular;
    KajiyaKayLight strand =
        kajiyaKay(probe.tangent, light.to_light, probe.to_eye, probe.exponent);
    probe.kajiya_kay_diffuse = strand.diffuse;
    probe.kajiya_kay_specular = strand.specular;
    Probes(push.probes).at[index] = probe;
}
