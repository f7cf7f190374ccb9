#version 460
// Computes the depth pyramid, on devices with 64-bit integers, with tiles as texels.
#extension GL_GOOGLE_include_directive : require
#define kTileTexels 0
#include "common/packed_vectors.glsl"

#include "strands/software/pyramid.glsl"
