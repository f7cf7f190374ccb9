#version 460
// The colors of samples, on devices with 64-bit integers, points and samples as texels.
#extension GL_GOOGLE_include_directive : require
#define kPointTexels 4
#define kSampleTexels 5
#include "common/packed_vectors.glsl"

#include "strands/software/shade.glsl"
