#version 460
// Alpha to coverage: a strand's fragment covers a part of its pixel's samples in proportion to its
// alpha. The samples are random for every fragment. Devices' own conversion uses the same samples
// for equal alphas, so that many faint strands on top of one another would never hide the
// background: Enderton et al. 2010, Stochastic transparency.
#extension GL_GOOGLE_include_directive : require
#include "common/random.glsl"
#include "strands/fragment.glsl"
#include "strands/pixel_margin.glsl"

layout(location = 0) out vec4 color;

// A random sample mask with a mean of alpha * kSamples bits over fragments.
uint sampleMask(float alpha) {
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    uint bits = hash(pixel.x | pixel.y << 16, floatBitsToUint(gl_FragCoord.z), kSamplesPurpose);
    uint count = min(uint(alpha * float(kSamples) + unitFloat(bits)), kSamples);
    uint mask = (1u << count) - 1u;
    uint turn = bits % kSamples;  // its low bits; unitFloat takes the high ones
    return (mask << turn | mask >> (kSamples - turn)) & ((1u << kSamples) - 1u);
}

void main() {
    vec4 strand = transparentStrand(PictureReference(push.picture).parameters);
    gl_SampleMask[0] = int(sampleMask(strand.a));
    color = vec4(strand.rgb, 1.0);
}
