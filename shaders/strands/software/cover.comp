#version 460
// Rasterises the pieces of strands.
#extension GL_GOOGLE_include_directive : require
#include "strands/software/offer.glsl"

#include "strands/software/cover_strands.glsl"
