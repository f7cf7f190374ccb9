#version 460
// Shades samples.
#extension GL_GOOGLE_include_directive : require
#include "common/vectors.glsl"

#include "strands/software/shade.glsl"
