#version 460
// Outputs samples' colours and depths.
#extension GL_GOOGLE_include_directive : require
#include "common/vectors.glsl"

#include "strands/software/blit.glsl"
