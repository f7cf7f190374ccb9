// Common code of the stages of the back end `software`: their push constants, and a buffer of what
// each sample of the picture shows.
#ifndef HAIRBENCH_SOFTWARE_GLSL
#define HAIRBENCH_SOFTWARE_GLSL

#include "common/picture.glsl"
#include "common/vectors.glsl"
#include "shared/software_structs.h"
#include "strands/pixel_margin.glsl"
#include "strands/points/layout.glsl"

layout(constant_id = kStrandBlockConstant) const uint kBlock = 1;  // strands per invocation

layout(push_constant, scalar) uniform Push { SoftwarePush push; };

layout(buffer_reference, scalar) buffer Counts { PieceCounts counts; };

layout(buffer_reference, scalar) buffer PieceList { uint at[]; };

// Bounds of the hair on the screen, px.
void hairBounds(out uvec2 low, out uvec2 high) {
    HairBounds bounds = Bounds(push.bounds).bounds;
    low = uvec2(push.width - bounds.from_right, push.height - bounds.from_bottom);
    high = uvec2(bounds.right, bounds.bottom);
}

layout(buffer_reference, scalar) buffer TileDepths { uint at[]; };

uint tileIndex(uvec2 tile) { return tile.y * ((push.width + kTile - 1u) / kTile) + tile.x; }

uint sampleIndex(uvec2 pixel, uint index) {
    return (pixel.y * push.width + pixel.x) * kSamples + index;
}

#endif
