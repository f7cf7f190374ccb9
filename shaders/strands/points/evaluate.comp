#version 460
// Evaluates the points of strands.
#extension GL_GOOGLE_include_directive : require
#include "common/vectors.glsl"

#include "strands/points/evaluate.glsl"
