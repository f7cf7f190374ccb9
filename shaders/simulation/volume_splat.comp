#version 460
// Adds the share and the momentum of every guide vertex to the grids, in integers: their sum is the
// same in any order. One invocation per vertex.
#extension GL_GOOGLE_include_directive : require

#include "simulation/volume.glsl"

layout(local_size_x = kGuideGroupSize) in;

layout(push_constant, scalar) uniform Push { VolumePush push; };

void main() {
    VolumeParameters volume = VolumeReference(push.volume).parameters;
    GuideParameters guides = GuideReference(push.guides).parameters;
    uint index = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= guides.strand_count * guides.vertices_per_strand) return;  // no barrier follows

    VolumeSample vertex = Samples(volume.samples).at[index];
    float momentum_scale = momentumScale(uintBitsToFloat(Fastest(volume.fastest).bits));
    vec4 whole = scaled(vertex, momentum_scale);
    Sums sums = Sums(volume.sums);
    for (uint grid = 0; grid < kVolumeGrids; ++grid) {
        vec3 point = onGrid(vertex.point, grid);
        ivec3 middle = ivec3(floor(point));
        Splines splines = splinesAt(point, middle);
        [[unroll]] for (uint i = 0; i < kStencil; ++i) {
            ivec4 sum = fixedPoint(whole, weight(splines, i));
            uint first = 4 * cellIndex(grid, middle + stencilOffset(i), volume.resolution);
            for (uint k = 0; k < 4; ++k)
                if (sum[k] != 0) atomicAdd(sums.at[first + k], sum[k]);
        }
    }
}
