#version 460
// Lists the potentially visible pieces of strands, with points and windows as texels.
#extension GL_GOOGLE_include_directive : require
#define kPointTexels 0
#define kWindowTexels 1
#include "common/packed_vectors.glsl"

#include "strands/software/find.glsl"
