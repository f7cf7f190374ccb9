#version 460
// Evaluates the environment's functions in some directions.
#extension GL_GOOGLE_include_directive : require
#include "common/picture.glsl"
#include "environment/radiance.glsl"
#include "probes.glsl"
#include "shading/environment.glsl"

layout(buffer_reference, scalar) readonly buffer ProbeDirections { vec3 directions[]; };
layout(buffer_reference, scalar) writeonly buffer ProbeLight { vec3 light[]; };
layout(push_constant, scalar) uniform Push { EnvironmentProbePush push; };
layout(local_size_x = 64) in;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    PictureParameters picture;
    picture.environment = push.environment;
    vec3 direction = ProbeDirections(push.directions).directions[i];
    ProbeLight(push.radiance).light[i] = environmentRadiance(push.environment, direction);
    ProbeLight(push.light).light[i] = environmentLight(picture, direction);
}
