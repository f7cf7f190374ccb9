#version 460
// Adds the share and the momentum of every guide vertex to the grids. The sums are integers, so
// they are the same in any order. One invocation per vertex.
#extension GL_GOOGLE_include_directive : require
#ifdef HAIRBENCH_PACKED
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require
#endif
#include "simulation/volume.glsl"

#ifdef HAIRBENCH_PACKED
// One atomic operation on a 64-bit integer for two components. The lower component of a pair
// borrows from the upper one if its sum is negative (VolumeParameters::borrows). Shares are never
// negative.
layout(buffer_reference, scalar) buffer Sums { uint64_t at[]; };

uint64_t packed(int low, int high) { return uint64_t(int64_t(low)) + (uint64_t(uint(high)) << 32); }

void addToCell(Address sums, uint cell, ivec4 parts) {
    atomicAdd(Sums(sums).at[2 * cell], packed(parts.x, parts.y));
    atomicAdd(Sums(sums).at[2 * cell + 1], packed(parts.z, parts.w));
}
#else
layout(buffer_reference, scalar) buffer Sums { int at[]; };

void addToCell(Address sums, uint cell, ivec4 parts) {
    for (uint k = 0; k < 4; ++k)
        if (parts[k] != 0) atomicAdd(Sums(sums).at[4 * cell + k], parts[k]);
}
#endif

layout(local_size_x = kGuideGroupSize) in;

layout(push_constant, scalar) uniform Push { VolumePush push; };

void main() {
    VolumeParameters volume = VolumeReference(push.volume).parameters;
    GuideParameters guides = GuideReference(push.guides).parameters;
    uint index = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= guides.strand_count * guides.vertices_per_strand) return;  // no barrier follows

    VolumeSample vertex = Samples(volume.samples).at[index];
    vec4 parts = partsOf(vertex);
    Blocks blocks = Blocks(volume.blocks);
    for (uint grid = 0; grid < kVolumeGrids; ++grid) {
        vec3 point = onGrid(vertex.point, grid);
        ivec3 middle = ivec3(floor(point));
        Splines splines = splinesAt(point, middle);
        VISIT_SLICES(z) {
            vec2 scales[kStencil];
            findScales(blocks, grid, middle, z, volume.resolution, scales);
            [[unroll]] for (uint i = 0; i < kSlices * kSliceCells; ++i) {
                ivec3 cell = middle + stencilOffset(i, z);
                addToCell(
                    volume.sums, cellIndex(grid, cell, volume.resolution),
                    inFixedPoint(parts, weight(valuesOf(splines, i, z)), scales[i]));
            }
        }
    }
}
