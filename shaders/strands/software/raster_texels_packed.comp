#version 460
// Rasterises the pieces of strands, on devices with 64-bit atomics, with points and samples as
// texels.
#extension GL_GOOGLE_include_directive : require
#define kPointTexels 0
#define kVisibilityTexels 1
#include "strands/software/depth_test_packed.glsl"

#include "strands/software/raster_pieces.glsl"
