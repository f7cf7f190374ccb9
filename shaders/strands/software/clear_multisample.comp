#version 460
// Clears samples, with several per pixel.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#define HAIRBENCH_MULTISAMPLE
#include "common/vectors.glsl"

#include "strands/software/clear.glsl"
