#version 460
// Evaluates the points of strands, on devices with 64-bit integers.
#extension GL_GOOGLE_include_directive : require
#include "common/packed_vectors.glsl"

#include "strands/points/evaluate.glsl"
