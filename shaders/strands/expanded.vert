#version 460
// Draws strands' quads from evaluated points.
#extension GL_GOOGLE_include_directive : require
#include "common/vectors.glsl"
#include "strands/quad.glsl"

#include "strands/points/expanded.glsl"
