#version 460
// Computes the depth pyramid, on devices with 64-bit integers.
#extension GL_GOOGLE_include_directive : require
#include "common/packed_vectors.glsl"

#include "strands/software/pyramid.glsl"
