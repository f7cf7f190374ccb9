#version 460
// Draws strands' quads in a light's map from evaluated points.
#extension GL_GOOGLE_include_directive : require
#include "common/vectors.glsl"
#include "shadows/quad.glsl"

#include "strands/points/expanded.glsl"
