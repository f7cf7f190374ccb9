#version 460
// The pieces of strands that may be seen.
#extension GL_GOOGLE_include_directive : require
#include "common/vectors.glsl"

#include "strands/software/find.glsl"
