#version 460
// Strands' quads in a light's map from their points.
#extension GL_GOOGLE_include_directive : require
#include "common/vectors.glsl"
#include "shadows/quad.glsl"

#include "strands/points/expanded.glsl"
