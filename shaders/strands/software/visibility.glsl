// Reads a sample. With kVisibilityTexels, lavapipe reads those of eight invocations at once.
#ifndef HAIRBENCH_SEEN_GLSL
#define HAIRBENCH_SEEN_GLSL

#extension GL_EXT_samplerless_texture_functions : require

#include "strands/software/software.glsl"

#ifdef kVisibilityTexels
layout(binding = kVisibilityTexels) uniform utextureBuffer visibility_texels;

uvec2 fetchVisibility(uint index) { return texelFetch(visibility_texels, int(index)).xy; }
#else
uvec2 fetchVisibility(uint index) { return loadPair(push.visibility, index); }
#endif

#endif
