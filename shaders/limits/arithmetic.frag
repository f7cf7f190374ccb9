#version 460
// How fast the fragment stage calculates.
#extension GL_GOOGLE_include_directive : require
#include "limits/arithmetic.glsl"

layout(location = 0) out vec4 color;

void main() { color = vec4(chains(fract(gl_FragCoord.x / 64.0))); }
