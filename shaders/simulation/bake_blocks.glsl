#ifndef HAIRBENCH_BAKE_BLOCKS_GLSL
#define HAIRBENCH_BAKE_BLOCKS_GLSL

#include "shared/distance_field_structs.h"

// Blocks of grid points. A work group bakes one block.

// Returns the point of a lane in Morton order. Eight consecutive invocations are a cube of points,
// so invocations that run together take nearly the same search path.
uvec3 pointInBlock(uint lane) {
    uvec3 low = uvec3(lane, lane >> 1, lane >> 2) & 1u;
    uvec3 high = uvec3(lane >> 3, lane >> 4, lane >> 5) & 1u;
    return low + 2u * high;
}

// Returns the position of a block in a grid of `blocks` blocks along each axis.
uvec3 placeOf(uint block, uvec3 blocks) {
    return uvec3(block, block / blocks.x, block / blocks.x / blocks.y) % blocks;
}

#endif
