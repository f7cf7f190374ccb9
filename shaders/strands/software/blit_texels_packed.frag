#version 460
// Outputs samples' colours and depths, on devices with 64-bit integers, with samples as texels.
#extension GL_GOOGLE_include_directive : require
#define kVisibilityTexels 0
#include "common/packed_vectors.glsl"

#include "strands/software/blit.glsl"
