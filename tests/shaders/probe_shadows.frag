#version 460
// Evaluates the light's path to points that the host chooses, one per column.
#extension GL_GOOGLE_include_directive : require
#define HAIRBENCH_SHADOW_BINDING 0
#include "common/picture.glsl"
#include "probes.glsl"
#include "shading/shadows.glsl"

layout(buffer_reference, scalar) readonly buffer Probes { ShadowProbe at[]; };
layout(push_constant, scalar) uniform Push { ShadowProbePush push; };
layout(location = 0) out vec4 path;  // meshes, strands, visibility, direct
layout(location = 1) out vec4 behind;  // scatter_count, ended, returned, multiple_scattering

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    // Helper invocations beyond the last pixels run too, and have no probe.
    uint column = min(uint(gl_FragCoord.x), push.count - 1u);
    ShadowProbe probe = Probes(push.probes).at[column];
    LightPath found = lightPath(
        picture, probe.light,
        Receiver(
            probe.position, probe.normal, probe.tangent, probe.width,
            surfaceTransmittance(picture)));
    path = vec4(found.meshes, found.strands, visibility(found).g, found.direct);
    behind = vec4(found.scatter_count, found.ended.g, found.returned.g, found.multiple_scattering);
}
