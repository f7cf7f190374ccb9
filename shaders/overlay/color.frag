#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/picture.glsl"

layout(push_constant, scalar) uniform Push { OverlayPush push; };
layout(location = 0) out vec4 color;

void main() { color = vec4(push.color, 1.0); }
