#version 460
// Measures the arithmetic rate of the fragment stage.
#extension GL_GOOGLE_include_directive : require
#include "limits/arithmetic.glsl"

layout(location = 0) out vec4 color;

void main() { color = vec4(chains(fract(gl_FragCoord.x / 64.0))); }
