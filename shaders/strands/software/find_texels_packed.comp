#version 460
// The pieces of strands that may be seen, points and windows as texels.
#extension GL_GOOGLE_include_directive : require
#define kPointTexels 0
#define kWindowTexels 1
#include "common/packed_vectors.glsl"

#include "strands/software/find.glsl"
