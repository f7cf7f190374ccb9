#version 460
// Lists the potentially visible pieces of strands, with points and the depth pyramid as texels.
#extension GL_GOOGLE_include_directive : require
#define kPointTexels 0
#define kPyramidTexels 1
#include "common/packed_vectors.glsl"

#include "strands/software/cull.glsl"
