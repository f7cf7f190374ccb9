#version 460
// Computes the depth pyramid.
#extension GL_GOOGLE_include_directive : require
#include "common/vectors.glsl"

#include "strands/software/pyramid.glsl"
