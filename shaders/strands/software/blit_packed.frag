#version 460
// Outputs samples' colours and depths, on devices with 64-bit integers.
#extension GL_GOOGLE_include_directive : require
#include "common/packed_vectors.glsl"

#include "strands/software/blit.glsl"
