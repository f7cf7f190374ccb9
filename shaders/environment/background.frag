#version 460
// Draws the environment as the background.
#extension GL_GOOGLE_include_directive : require
#include "common/display_color.glsl"
#include "common/picture.glsl"
#include "environment/radiance.glsl"
#include "shared/options.h"

layout(push_constant, scalar) uniform Push { EnvironmentPush push; };
// 1: working colours are linear
layout(constant_id = kBackgroundLinearLightConstant) const uint kLinearLight = 0;

layout(location = 0) in vec3 direction;
layout(location = 0) out vec4 color;

void main() {
    vec3 light = environmentRadiance(push.environment, normalize(direction));
    if (kLinearLight == 0u) light = toDisplay(min(light, vec3(1.0)));
    color = vec4(light, 1.0);
}
