#version 460
// Rasterises large pieces.
#extension GL_GOOGLE_include_directive : require
#include "strands/software/depth_test.glsl"

#include "strands/software/raster_large.glsl"
