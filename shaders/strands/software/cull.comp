#version 460
// Lists the potentially visible pieces of strands.
#extension GL_GOOGLE_include_directive : require
#include "common/vectors.glsl"

#include "strands/software/cull.glsl"
