#ifndef HAIRBENCH_BAKE_BLOCKS_GLSL
#define HAIRBENCH_BAKE_BLOCKS_GLSL

#include "shared/distance_field_structs.h"

// The blocks of grid points that workgroups bake.

// In Morton order: eight invocations in a row are a cube of points, so that those that run together
// search nearly the same way.
uvec3 pointInBlock(uint lane) {
    uvec3 low = uvec3(lane, lane >> 1, lane >> 2) & 1u;
    uvec3 high = uvec3(lane >> 3, lane >> 4, lane >> 5) & 1u;
    return low + 2u * high;
}

// Where a block is among `blocks` along each axis.
uvec3 placeOf(uint block, uvec3 blocks) {
    return uvec3(block, block / blocks.x, block / blocks.x / blocks.y) % blocks;
}

#endif
