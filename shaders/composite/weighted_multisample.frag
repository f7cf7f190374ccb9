#version 460
// Composites one sample of every pixel.
#extension GL_GOOGLE_include_directive : require
#include "common/extensions.glsl"
#include "composite/weighted.glsl"
#include "shared/fragment_structs.h"

layout(push_constant, scalar) uniform Push { CompositePush push; };
layout(binding = 0) uniform sampler2DMS weighted_sum;
layout(binding = 1) uniform sampler2DMS revealed_part;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    int i = int(push.sample_index);
    gl_SampleMask[0] = 1 << i;
    blendWeighted(texelFetch(weighted_sum, pixel, i), texelFetch(revealed_part, pixel, i).r);
}
