// Adds the share and the momentum of every guide vertex to the grids. The sums are integers, so
// they are the same in any order. One invocation per vertex. Define addToCell(address of the sums,
// number of a cell, share and momentum) first.
#include "simulation/volume.glsl"

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
        vec2 scales[kStencil];
        findScales(blocks, grid, middle, volume.resolution, scales);
        [[unroll]] for (uint i = 0; i < kStencil; ++i) {
            ivec3 cell = middle + stencilOffset(i);
            addToCell(
                volume.sums, cellIndex(grid, cell, volume.resolution),
                inFixedPoint(parts, weight(splines, i), scales[i]));
        }
    }
}
