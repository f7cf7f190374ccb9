#version 460
// Shades samples, on devices with 64-bit integers.
#extension GL_GOOGLE_include_directive : require
#include "common/packed_vectors.glsl"

#include "strands/software/shade.glsl"
