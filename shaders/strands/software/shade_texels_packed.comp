#version 460
// Shades samples, on devices with 64-bit integers, with points and samples as texels.
#extension GL_GOOGLE_include_directive : require
#define kPointTexels 4
#define kVisibilityTexels 5
#include "common/packed_vectors.glsl"

#include "strands/software/shade.glsl"
