#version 460
#extension GL_GOOGLE_include_directive : require
#include "composite/weighted.glsl"

layout(binding = 0) uniform sampler2D weighted_sum;
layout(binding = 1) uniform sampler2D revealed_part;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    blendWeighted(texelFetch(weighted_sum, pixel, 0), texelFetch(revealed_part, pixel, 0).r);
}
