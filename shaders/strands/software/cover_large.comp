#version 460
// Rasterises large pieces.
#extension GL_GOOGLE_include_directive : require
#include "strands/software/offer.glsl"

#include "strands/software/cover_large.glsl"
