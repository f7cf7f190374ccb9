#version 460
// Rasterises the pieces of strands, on devices with 64-bit atomics, with points and samples as
// texels.
#extension GL_GOOGLE_include_directive : require
#define kPointTexels 0
#define kSampleTexels 1
#include "strands/software/offer_packed.glsl"

#include "strands/software/cover_strands.glsl"
