#version 460
// Computes the nearness of the farthest sample of each tile: anything farther is hidden there. One
// work group per row of tiles.
#extension GL_GOOGLE_include_directive : require
#ifdef HAIRBENCH_TEXELS
#define kVisibilityTexels 0
#endif
#include "strands/software/visibility.glsl"

layout(local_size_x_id = kGroupConstant) in;

uint farthest(uvec2 begin, uvec2 end) {
    uint far = 0u;
    for (uint y = begin.y; y < end.y; ++y) {
        uint last = sampleIndex(uvec2(end.x, y), 0u);
        for (uint i = sampleIndex(uvec2(begin.x, y), 0u); i < last; ++i)
            far = max(far, fetchVisibility(i).y);
    }
    return far;
}

void main() {
    uvec2 low;
    uvec2 high;
    hairBounds(low, high);
    uvec2 tile = uvec2(low.x / kTile, gl_WorkGroupID.x);
    if (tile.y * kTile + kTile <= low.y || tile.y * kTile >= high.y) return;
    for (tile.x += gl_LocalInvocationID.x; tile.x * kTile < high.x; tile.x += gl_WorkGroupSize.x)
        TileDepths(push.tile_depths).at[tileIndex(tile)] =
            farthest(max(tile * kTile, low), min((tile + 1u) * kTile, high));
}
