#version 460
// Draws strands' quads from evaluated points, on devices with 64-bit integers.
#extension GL_GOOGLE_include_directive : require
#include "common/packed_vectors.glsl"
#include "strands/quad.glsl"

#include "strands/points/expanded.glsl"
