#version 460
// How near the farthest sample of each window of tiles is, by the tile that it begins with: of a small
// window and of a large one. A workgroup a row of windows.
#extension GL_GOOGLE_include_directive : require
#include "common/vectors.glsl"

#include "strands/software/software.glsl"

layout(local_size_x = kSoftwarePixelGroup) in;

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
        for (uint i = 0u; i < kLargeWindow * kLargeWindow; ++i) {
            uvec2 from_first = uvec2(i % kLargeWindow, i / kLargeWindow);
            uvec2 tile = first + from_first;
            // Beside the bounds there is no hair.
            uint depth = all(lessThan(tile, high)) ? TileDepths(push.tiles).at[tileIndex(tile)] : 0u;
            far.y = max(far.y, depth);
            if (all(lessThan(from_first, uvec2(kSmallWindow)))) far.x = max(far.x, depth);
        }
        storePair(push.windows, tileIndex(first), far);
    }
}
