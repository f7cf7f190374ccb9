#version 460
// Makes one fragment over the picture from the sums of strands/weighted.frag: McGuire and Bavoil
// 2013, equations (6) and following. With HAIRBENCH_MULTISAMPLE it composites one sample of every
// pixel.
#extension GL_GOOGLE_include_directive : require
#ifdef HAIRBENCH_MULTISAMPLE
#include "common/extensions.glsl"
#include "shared/fragment_structs.h"

layout(push_constant, scalar) uniform Push { CompositePush push; };
layout(binding = 0) uniform sampler2DMS weighted_sum;
layout(binding = 1) uniform sampler2DMS revealed_part;

int sampleIndex() { return int(push.sample_index); }
#else
layout(binding = 0) uniform sampler2D weighted_sum;
layout(binding = 1) uniform sampler2D revealed_part;

int sampleIndex() { return 0; }  // the mip level
#endif
layout(location = 0) out vec4 color;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    int i = sampleIndex();
#ifdef HAIRBENCH_MULTISAMPLE
    gl_SampleMask[0] = 1 << i;
#endif
    vec4 weighted = texelFetch(weighted_sum, pixel, i);
    float revealed = texelFetch(revealed_part, pixel, i).r;
    if (weighted.a <= 0.0) discard;
    if (isinf(weighted.a)) weighted = vec4(1.0);  // half floats overflowed: at least not black
    color = vec4(weighted.rgb / weighted.a, 1.0 - revealed);
}
