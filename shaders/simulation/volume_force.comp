#version 460
// Adds friction and repulsion from the grids to every guide vertex's acceleration; hair_hair.h has
// the equations. One invocation per vertex.
#extension GL_GOOGLE_include_directive : require

#include "simulation/volume.glsl"

layout(local_size_x = kGuideGroupSize) in;

layout(push_constant, scalar) uniform Push { VolumePush push; };

layout(buffer_reference, scalar) readonly buffer Cells { ivec4 at[]; };

// Returns share and momentum of a cell, in its block's fixed point.
ivec4 sumAt(VolumeParameters volume, uint cell) {
    ivec4 sum = Cells(volume.sums).at[cell];
    if (volume.borrows == 1 && sum.z < 0) ++sum.w;
    return sum;
}

// The pressure's potential in a cell with this share, divided by the setting of the repulsion.
float potential(float share, float crowded) { return log(max(share / crowded, 1.0)); }

void main() {
    VolumeParameters volume = VolumeReference(push.volume).parameters;
    GuideParameters guides = GuideReference(push.guides).parameters;
    uint index = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= guides.strand_count * guides.vertices_per_strand) return;  // no barrier follows

    Samples samples = Samples(volume.samples);
    Blocks blocks = Blocks(volume.blocks);
    VolumeSample vertex = samples.at[index];
    uint root = index - index % guides.vertices_per_strand;

    vec3 dragged = vec3(0.0);  // m/s
    vec3 pushed = vec3(0.0);   // 1/cell, head axes
    for (uint grid = 0; grid < kVolumeGrids; ++grid) {
        vec3 point = onGrid(vertex.point, grid);
        ivec3 middle = ivec3(floor(point));
        Splines splines = splinesAt(point, middle);
        Splines slopes = slopesAt(point, middle);
        VISIT_SLICES(z) {
            vec2 scales[kStencil];
            findScales(blocks, grid, middle, z, volume.resolution, scales);

            // Contributions of the vertex's own strand to the cells.
            ivec4 own[kStencil];
            [[unroll]] for (uint i = 0; i < kSlices * kSliceCells; ++i) own[i] = ivec4(0);
            for (uint v = root; v < root + guides.vertices_per_strand; ++v) {
                VolumeSample other = samples.at[v];
                vec3 away = abs(other.point - vertex.point);
                if (max(away.x, max(away.y, away.z)) > 3.0) continue;  // no cell in common
                Splines its = splinesAt(onGrid(other.point, grid), middle);
                vec4 parts = partsOf(other);
                [[unroll]] for (uint i = 0; i < kSlices * kSliceCells; ++i)
                    own[i] += inFixedPoint(parts, weight(valuesOf(its, i, z)), scales[i]);
            }

            [[unroll]] for (uint i = 0; i < kSlices * kSliceCells; ++i) {
                ivec3 cell = middle + stencilOffset(i, z);
                ivec4 sum = sumAt(volume, cellIndex(grid, cell, volume.resolution));
                ivec4 others = sum - own[i];
                float share_unit = inverseOf(scales[i].x);
                vec3 momentum = inverseOf(scales[i].y) * vec3(others.yzw);
                // A cell without hair has no part of this vertex either.
                vec3 values = valuesOf(splines, i, z);
                dragged += weight(values) *
                           (momentum - share_unit * float(others.x) * vertex.velocity) /
                           (share_unit * float(max(sum.x, 1)));
                pushed -= (potential(share_unit * float(sum.x), volume.crowded) -
                           potential(share_unit * float(own[i].x), volume.crowded)) *
                          weightGradient(values, valuesOf(slopes, i, z));
            }
        }
    }
    dragged /= float(kVolumeGrids);
    pushed /= float(kVolumeGrids);

    vec3 repulsion = volume.repulsion * rotate(push.frame.rotation, pushed);
    float size = length(repulsion);
    if (size > volume.greatest_repulsion) repulsion *= volume.greatest_repulsion / size;

    vec4 kept = State(volume.kept).at[index];
    vec3 driven = kept.w == 0.0 ? vec3(0.0) : dragged - kept.xyz;  // m/s, by everything except
                                                                   // friction
    vec3 friction = volume.settled * dragged + volume.predicted * driven;
    State(volume.kept).at[index] = vec4(dragged - friction, 1.0);
    State(push.accelerations).at[index].xyz += volume.per_step * friction + repulsion;
}
