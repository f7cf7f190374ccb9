#version 460
// Computes the depths of tiles, on devices with 64-bit integers, with samples as texels.
#extension GL_GOOGLE_include_directive : require
#define kVisibilityTexels 0
#include "common/packed_vectors.glsl"

#include "strands/software/tiles.glsl"
