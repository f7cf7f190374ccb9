// Reads a sample. With kSampleTexels, lavapipe reads those of eight invocations at once.
#ifndef HAIRBENCH_SEEN_GLSL
#define HAIRBENCH_SEEN_GLSL

#extension GL_EXT_samplerless_texture_functions : require

#include "strands/software/software.glsl"

#ifdef kSampleTexels
layout(binding = kSampleTexels) uniform utextureBuffer sample_texels;

uvec2 fetchSample(uint index) { return texelFetch(sample_texels, int(index)).xy; }
#else
uvec2 fetchSample(uint index) { return loadPair(push.samples, index); }
#endif

#endif
