#version 460
// Computes the depths of tiles.
#extension GL_GOOGLE_include_directive : require
#include "common/vectors.glsl"

#include "strands/software/tiles.glsl"
