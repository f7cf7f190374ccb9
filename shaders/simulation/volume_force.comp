#version 460
// Friction and repulsion by the grids, added to every guide vertex's acceleration; hair_hair.h has
// the equations. One invocation per vertex.
#extension GL_GOOGLE_include_directive : require

#include "simulation/volume.glsl"

layout(local_size_x = kGuideGroupSize) in;

layout(push_constant, scalar) uniform Push { VolumePush push; };

float shareOf(int fixed_point) { return float(fixed_point) / float(kVolumeOne); }

// The pressure's potential in a cell with that share in it, over the repulsion's setting.
float potential(int fixed_point, float crowded) {
    return log(max(shareOf(fixed_point) / crowded, 1.0));
}

ivec4 sumAt(VolumeParameters volume, uint grid, ivec3 cell) {
    uint first = 4 * cellIndex(grid, cell, volume.resolution);
    Sums sums = Sums(volume.sums);
    return ivec4(sums.at[first], sums.at[first + 1], sums.at[first + 2], sums.at[first + 3]);
}

void main() {
    VolumeParameters volume = VolumeReference(push.volume).parameters;
    GuideParameters guides = GuideReference(push.guides).parameters;
    uint index = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= guides.strand_count * guides.vertices_per_strand) return;  // no barrier follows

    Samples samples = Samples(volume.samples);
    VolumeSample vertex = samples.at[index];
    float fastest = uintBitsToFloat(Fastest(volume.fastest).bits);
    float momentum_scale = momentumScale(fastest);
    uint root = index - index % guides.vertices_per_strand;

    vec3 dragged = vec3(0.0);  // m/s
    vec3 pushed = vec3(0.0);   // 1/cell, axes of the head
    for (uint grid = 0; grid < kVolumeGrids; ++grid) {
        vec3 point = onGrid(vertex.point, grid);
        ivec3 middle = ivec3(floor(point));

        // What the own strand has added to the cells.
        ivec4 own[kStencil];
        [[unroll]] for (uint i = 0; i < kStencil; ++i) own[i] = ivec4(0);
        for (uint v = root; v < root + guides.vertices_per_strand; ++v) {
            VolumeSample other = samples.at[v];
            vec3 away = abs(other.point - vertex.point);
            if (max(away.x, max(away.y, away.z)) > 3.0) continue;  // no cell in common
            Splines splines = splinesAt(onGrid(other.point, grid), middle);
            vec4 whole = scaled(other, momentum_scale);
            [[unroll]] for (uint i = 0; i < kStencil; ++i)
                own[i] += fixedPoint(whole, weight(splines, i));
        }

        Splines splines = splinesAt(point, middle);
        Splines slopes = slopesAt(point, middle);
        [[unroll]] for (uint i = 0; i < kStencil; ++i) {
            ivec4 sum = sumAt(volume, grid, middle + stencilOffset(i));
            ivec4 others = sum - own[i];
            vec3 momentum = vec3(others.xyz) / float(kVolumeOne) * fastest;
            // A cell without hair has none of the vertex's either.
            dragged += weight(splines, i) *
                       (momentum - shareOf(others.w) * vertex.velocity) / shareOf(max(sum.w, 1));
            pushed -=
                (potential(sum.w, volume.crowded) - potential(own[i].w, volume.crowded)) *
                weightGradient(splines, slopes, i);
        }
    }
    dragged /= float(kVolumeGrids);
    pushed /= float(kVolumeGrids);

    vec3 repulsion = volume.repulsion * rotate(push.frame.rotation, pushed);
    float size = length(repulsion);
    if (size > volume.greatest_repulsion) repulsion *= volume.greatest_repulsion / size;
    State(push.accelerations).at[index].xyz += volume.friction * dragged + repulsion;
}
