#version 460
// Adds to every cell how far its vertices' potentials are from their mean (YieldPush). The sums are
// integers, so they are the same in any order. One invocation per vertex.
#extension GL_GOOGLE_include_directive : require
#ifdef HAIRBENCH_PACKED
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require
#endif
#include "simulation/volume.glsl"

#ifdef HAIRBENCH_PACKED
layout(buffer_reference, scalar) buffer Spreads { uint64_t at[]; };

void addToCell(Address spreads, uint cell, uvec2 parts) {
    atomicAdd(Spreads(spreads).at[cell], uint64_t(parts.x) + (uint64_t(parts.y) << 32));
}
#else
layout(buffer_reference, scalar) buffer Spreads { uint at[]; };

void addToCell(Address spreads, uint cell, uvec2 parts) {
    for (uint k = 0; k < 2; ++k)
        if (parts[k] != 0) atomicAdd(Spreads(spreads).at[2 * cell + k], parts[k]);
}
#endif

layout(local_size_x = kGuideGroupSize) in;

layout(push_constant, scalar) uniform Push { YieldPush push; };

void main() {
    VolumeParameters volume = VolumeReference(push.volume).parameters;
    GuideParameters guides = GuideReference(push.guides).parameters;
    uint index = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= guides.strand_count * guides.vertices_per_strand) return;  // no barrier follows

    VolumeSample vertex = Samples(volume.samples).at[index];
    Blocks blocks = Blocks(volume.blocks);
    for (uint grid = 0; grid < kVolumeGrids; ++grid) {
        vec3 point = onGrid(vertex.point, grid);
        ivec3 middle = ivec3(floor(point));
        Splines splines = splinesAt(point, middle);
        VISIT_SLICES(z) {
            vec2 scales[kStencil];
            findScales(blocks, grid, middle, z, volume.resolution, scales);
            [[unroll]] for (uint i = 0; i < kSlices * kSliceCells; ++i) {
                uint cell = cellIndex(grid, middle + stencilOffset(i, z), volume.resolution);
                ivec4 sum = sumAt(volume, cell);
                float per_unit = scales[i].y * inverseOf(scales[i].x);
                vec3 mean = vec3(sum.yzw) / (per_unit * float(max(sum.x, 1)));
                // Two vectors with components below 1 are at most sqrt(12) apart. Rounding may move
                // the mean of a cell with almost no hair.
                float away = min(
                    per_unit / kVolumeSpreadRange * length(vertex.velocity - mean), 1.0);
                vec2 parts = vertex.share * vec2(away, away * away);
                addToCell(
                    push.spreads, cell,
                    uvec2(round(weight(valuesOf(splines, i, z)) * scales[i].x * parts)));
            }
        }
    }
}
