// The grids of hair's density and momentum. Cells are numbered from the grid's corner. The grids
// turn and move with the head. Quadratic B-splines spread a vertex over 3 x 3 x 3 cells of each, so
// density is smooth in the vertex's position and its gradient is continuous.
#ifndef HAIRBENCH_SIMULATION_VOLUME_GLSL
#define HAIRBENCH_SIMULATION_VOLUME_GLSL

#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "common/rigid_frame.glsl"
#include "shared/volume_structs.h"
#include "simulation/guides.glsl"

layout(buffer_reference, scalar) readonly buffer VolumeReference { VolumeParameters parameters; };
layout(buffer_reference, scalar) buffer Samples { VolumeSample at[]; };
layout(buffer_reference, scalar) buffer Blocks { VolumeBlock at[]; };
layout(buffer_reference, scalar) readonly buffer Cells { ivec4 at[]; };

// Returns share and momentum of a cell, in its block's fixed point.
ivec4 sumAt(VolumeParameters volume, uint cell) {
    ivec4 sum = Cells(volume.sums).at[cell];
    if (volume.borrows == 1 && sum.z < 0) ++sum.w;
    return sum;
}

// A vertex is spread over the 27 cells round its own, its stencil. The block after VISIT_SLICES(z)
// visits kSlices slices of it from z, a slice being the 3 x 3 cells with one z: all three, so that
// the strand's vertices are found once, or, with HAIRBENCH_SLICES, one after the other, because all
// cells need more registers than GPUs have.
#ifdef HAIRBENCH_SLICES
const uint kSlices = 1;
#define VISIT_SLICES(z) for (uint z = 0; z < 3; ++z)
#else
const uint kSlices = 3;
#define VISIT_SLICES(z) const uint z = 0;
#endif
const uint kStencil = 27;
const uint kSliceCells = 9;
ivec3 stencilOffset(uint i, uint z) { return ivec3(i % 3, i / 3 % 3, z + i / kSliceCells) - 1; }

// Converts a point of the first grid to the coordinates of another.
vec3 onGrid(vec3 point, uint grid) { return point + 0.5 * float(grid); }

// The values, along each axis, of the quadratic B-splines centred in a cell and in its neighbours
// before and after it.
struct Splines {
    vec3 at[3];
};

Splines splinesAt(vec3 point, ivec3 cell) {
    Splines splines;
    for (int i = 0; i < 3; ++i) {
        vec3 away = abs(point - (vec3(cell + i) - 0.5));
        vec3 tail = max(1.5 - away, 0.0);
        splines.at[i] = mix(0.5 * tail * tail, 0.75 - away * away, lessThan(away, vec3(0.5)));
    }
    return splines;
}

// The slopes of the splines, 1/cell, for a point in the cell itself.
Splines slopesAt(vec3 point, ivec3 cell) {
    vec3 offset = point - (vec3(cell) + 0.5);
    return Splines(vec3[3](offset - 0.5, -2.0 * offset, offset + 0.5));
}

// The values along x, y and z for a cell of the slices from z.
vec3 valuesOf(Splines splines, uint i, uint z) {
    uint k = z + i / kSliceCells;
    float third = k == 0 ? splines.at[0].z : k == 1 ? splines.at[1].z : splines.at[2].z;
    return vec3(splines.at[i % 3].x, splines.at[i / 3 % 3].y, third);
}

// The part of a vertex that goes to the cell with these values.
float weight(vec3 values) { return values.x * values.y * values.z; }

// The gradient of weight() by the vertex's position, 1/cell.
vec3 weightGradient(vec3 values, vec3 slopes) { return slopes * values.yzx * values.zxy; }

uint cellIndex(uint grid, ivec3 cell, uint resolution) {
    uvec3 c = uvec3(cell);
    return ((grid * resolution + c.z) * resolution + c.y) * resolution + c.x;
}

uvec3 blockOf(ivec3 cell) { return uvec3(cell) >> kVolumeBlockBits; }

uint blockIndex(uint grid, uvec3 block, uint resolution) {
    return cellIndex(grid, ivec3(block), ((resolution - 1) >> kVolumeBlockBits) + 1);
}

float powerOfTwo(int exponent) { return uintBitsToFloat(uint(exponent + 127) << 23); }

// Returns 1 / x for a power of two.
float inverseOf(float power_of_two) {
    return uintBitsToFloat((254u << 23) - floatBitsToUint(power_of_two));
}

// A block's fixed-point scales: the factors for share and for share times velocity. They are powers
// of two, so they cause no rounding and are the same wherever they are computed. No weight is above
// (3/4)^3, so no sum is above 27/64 2^32. It fits an int, with room for the rounding errors of 6
// 10^8 vertices.
vec2 scalesOf(VolumeBlock block) {
    // Exponents of powers of two that exceed the share and the greatest speed. Hair slower than
    // 2^-62 m/s is irrelevant.
    int share = findMSB(block.share) + 1 - 31;
    int fastest = max(int(block.fastest >> 23) - 126, -62);
    return vec2(powerOfTwo(32 - share), powerOfTwo(32 - share - fastest));
}

// Finds the scales of the cells of the slices from z for a vertex in the cell `middle`. The cells
// lie in up to two blocks along each axis.
void findScales(
    Blocks blocks, uint grid, ivec3 middle, uint z, uint resolution, out vec2 scales[kStencil]) {
    uvec3 first = blockOf(middle + ivec3(-1, -1, int(z) - 1));
    uvec3 last = blockOf(middle + ivec3(1, 1, int(z + kSlices) - 2));
    vec2 corners[8];
    [[unroll]] for (uint i = 0; i < 8; ++i) {
        uvec3 block = mix(first, last, bvec3(i % 2 == 1, i / 2 % 2 == 1, i / 4 == 1));
        corners[i] = scalesOf(blocks.at[blockIndex(grid, block, resolution)]);
    }
    bvec3 is_last[3] = bvec3[3](bvec3(false), equal(blockOf(middle), last), bvec3(true));
    [[unroll]] for (uint k = 0; k < kSlices; ++k) {
        vec2 slice[4];
        [[unroll]] for (uint i = 0; i < 4; ++i)
            slice[i] = is_last[k].z ? corners[4 + i] : corners[i];
        [[unroll]] for (uint y = 0; y < 3; ++y) {
            vec2 low = is_last[y].y ? slice[2] : slice[0];
            vec2 high = is_last[y].y ? slice[3] : slice[1];
            [[unroll]] for (uint x = 0; x < 3; ++x)
                scales[(k * 3 + y) * 3 + x] = is_last[x].x ? high : low;
        }
    }
}

// Returns share and momentum of a vertex, in this order.
vec4 partsOf(VolumeSample vertex) { return vertex.share * vec4(1.0, vertex.velocity); }

// The contribution of a vertex to a cell. `parts` is from partsOf().
ivec4 inFixedPoint(vec4 parts, float weight, vec2 scales) {
    return ivec4(round((weight * scales).xyyy * parts));
}

#endif
