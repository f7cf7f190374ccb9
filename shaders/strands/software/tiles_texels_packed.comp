#version 460
// The depth of tiles, on devices with 64-bit integers, samples as texels.
#extension GL_GOOGLE_include_directive : require
#define kSampleTexels 0
#include "common/packed_vectors.glsl"

#include "strands/software/tiles.glsl"
