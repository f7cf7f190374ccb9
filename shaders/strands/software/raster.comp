#version 460
// Rasterises the pieces of strands.
#extension GL_GOOGLE_include_directive : require
#include "strands/software/depth_test.glsl"

#include "strands/software/raster_pieces.glsl"
