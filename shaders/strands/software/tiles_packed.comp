#version 460
// Computes the depths of tiles, on devices with 64-bit integers.
#extension GL_GOOGLE_include_directive : require
#include "common/packed_vectors.glsl"

#include "strands/software/tiles.glsl"
