#version 460
// The depth of windows, on devices with 64-bit integers, tiles as texels.
#extension GL_GOOGLE_include_directive : require
#define kTileTexels 0
#include "common/packed_vectors.glsl"

#include "strands/software/windows.glsl"
