#version 460
// Strands' quads from their points.
#extension GL_GOOGLE_include_directive : require
#include "common/vectors.glsl"
#include "strands/quad.glsl"

#include "strands/points/expanded.glsl"
