#version 460
// Draws strands in a light's map without tessellation or geometry stages.
#extension GL_GOOGLE_include_directive : require
#include "shadows/quad.glsl"

#include "strands/pulling.glsl"
