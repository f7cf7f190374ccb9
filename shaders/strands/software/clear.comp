#version 460
// Clears samples, with one per pixel.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "common/vectors.glsl"

#include "strands/software/clear.glsl"
