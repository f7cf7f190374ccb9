#version 460
// The samples of strands.
#extension GL_GOOGLE_include_directive : require
#include "strands/software/offer.glsl"

#include "strands/software/cover_strands.glsl"
