#version 460
// Samples without hair, one a pixel.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "common/vectors.glsl"

#include "strands/software/clear.glsl"
