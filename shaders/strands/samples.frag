#version 460
// A strand's quad that covers as many of its pixel's samples as its alpha says: alpha to coverage.
// The samples are random ones for every fragment, where devices' own conversion takes the same ones
// for equal alphas, so that many faint strands on one another would never hide what is behind them:
// Enderton et al. 2010, Stochastic transparency.
#extension GL_GOOGLE_include_directive : require
#include "common/random.glsl"
#include "strands/fragment.glsl"
#include "strands/pixel_samples.glsl"

layout(location = 0) out vec4 color;

// A random mask of samples: alpha * kSamples bits in the mean over fragments.
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
