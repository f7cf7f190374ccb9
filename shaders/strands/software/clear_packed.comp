#version 460
// Clears samples, with one per pixel, on devices with 64-bit integers.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "common/packed_vectors.glsl"

#include "strands/software/clear.glsl"
