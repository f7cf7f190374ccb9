#version 460
// Lists the potentially visible pieces of strands, on devices with 64-bit integers.
#extension GL_GOOGLE_include_directive : require
#include "common/packed_vectors.glsl"

#include "strands/software/cull.glsl"
