#version 460
// Computes the two levels of the depth pyramid: the nearness of the farthest sample in a square of
// tiles that begins at each tile. One work group per row of tiles.
#extension GL_GOOGLE_include_directive : require
#ifdef HAIRBENCH_TEXELS
#define kTileTexels 0
#endif
#include "strands/software/software.glsl"

#ifdef kTileTexels
#extension GL_EXT_samplerless_texture_functions : require
layout(binding = kTileTexels) uniform utextureBuffer tile_texels;

uint fetchTile(uvec2 tile) { return texelFetch(tile_texels, int(tileIndex(tile))).x; }
#else
uint fetchTile(uvec2 tile) { return TileDepths(push.tile_depths).at[tileIndex(tile)]; }
#endif


layout(local_size_x_id = kGroupConstant) in;

void main() {
    uvec2 low;
    uvec2 high;
    hairBounds(low, high);
    low /= kTile;
    high = (high + kTile - 1u) / kTile;
    uvec2 first = uvec2(low.x, gl_WorkGroupID.x);
    if (first.y < low.y || first.y >= high.y) return;
    for (first.x += gl_LocalInvocationID.x; first.x < high.x; first.x += gl_WorkGroupSize.x) {
        uvec2 far = uvec2(0u);
        for (uint i = 0u; i < kCoarseLevel * kCoarseLevel; ++i) {
            uvec2 from_first = uvec2(i % kCoarseLevel, i / kCoarseLevel);
            uvec2 tile = first + from_first;
            // There is no hair outside the bounds.
            uint depth = all(lessThan(tile, high)) ? fetchTile(tile) : 0u;
            far.y = max(far.y, depth);
            if (all(lessThan(from_first, uvec2(kFineLevel)))) far.x = max(far.x, depth);
        }
        storePair(push.pyramid, tileIndex(first), far);
    }
}
