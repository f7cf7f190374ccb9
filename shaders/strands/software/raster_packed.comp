#version 460
// Rasterises the pieces of strands, on devices with 64-bit atomics.
#extension GL_GOOGLE_include_directive : require
#include "strands/software/depth_test_packed.glsl"

#include "strands/software/raster_pieces.glsl"
