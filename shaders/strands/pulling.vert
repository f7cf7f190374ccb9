#version 460
// Draws strands without tessellation or geometry stages.
#extension GL_GOOGLE_include_directive : require
#include "strands/quad.glsl"

#include "strands/pulling.glsl"
