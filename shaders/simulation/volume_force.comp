#version 460
// Adds friction and repulsion from the grids to every guide vertex's acceleration; hair_hair.h has
// the equations. One invocation per vertex. With HAIRBENCH_YIELD, friction holds up to a yield
// stress. With HAIRBENCH_ATTRACTION, hair attracts hair.
#extension GL_GOOGLE_include_directive : require

#include "simulation/volume.glsl"

layout(local_size_x = kGuideGroupSize) in;

#ifdef HAIRBENCH_ATTRACTION
#define AND_ATTRACTION VolumeAttraction attraction;
#else
#define AND_ATTRACTION
#endif

#ifdef HAIRBENCH_YIELD
layout(push_constant, scalar) uniform Push { YieldPush push; AND_ATTRACTION };
layout(buffer_reference, scalar) readonly buffer Spreads { uvec2 at[]; };

// The part of its elastic friction that hair in a cell bears, from the cell's share, both sums of
// Spreads over the sum of shares, and the unit of the potential, m/s.
float heldPart(float share, float crowded, vec2 spread, float unit) {
    if (spread.x <= 0.0) return 1.0;
    // The square may be rounded to zero. No distribution has less than the second term.
    float jump = 2.0 * unit * max(spread.y / spread.x, spread.x);
    float yield = push.cohesive + push.pressed * max(1.0 - crowded / share, 0.0);
    return jump <= yield ? 1.0 : yield / jump;
}
#else
layout(push_constant, scalar) uniform Push { VolumePush push; AND_ATTRACTION };
#endif

#ifdef HAIRBENCH_ATTRACTION
// The potential of repulsion and attraction in a cell with this share, over a cell, m/s^2.
float potential(float share, float crowded) {
    return attraction.repulsion * log(max(share / crowded, 1.0)) -
           attraction.attraction * min(share / crowded, 1.0);
}
#else
// The pressure's potential in a cell with this share, divided by the setting of the repulsion.
float potential(float share, float crowded) { return log(max(share / crowded, 1.0)); }
#endif

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
#ifdef HAIRBENCH_YIELD
    vec3 held = vec3(0.0);  // m/s, of `dragged`
#endif
    vec3 pushed = vec3(0.0);   // head axes; 1/cell, or m/s^2 with attraction
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
                vec3 drag = weight(values) *
                            (momentum - share_unit * float(others.x) * vertex.velocity) /
                            (share_unit * float(max(sum.x, 1)));
                dragged += drag;
#ifdef HAIRBENCH_YIELD
                vec2 spread = vec2(
                    Spreads(push.spreads).at[cellIndex(grid, cell, volume.resolution)]);
                held += heldPart(
                            share_unit * float(max(sum.x, 1)), volume.crowded,
                            spread / float(max(sum.x, 1)),
                            kVolumeSpreadRange * scales[i].x * inverseOf(scales[i].y)) *
                        drag;
#endif
                pushed -= (potential(share_unit * float(sum.x), volume.crowded) -
                           potential(share_unit * float(own[i].x), volume.crowded)) *
                          weightGradient(values, valuesOf(slopes, i, z));
            }
        }
    }
    dragged /= float(kVolumeGrids);
    pushed /= float(kVolumeGrids);

#ifdef HAIRBENCH_ATTRACTION
    vec3 repulsion = rotate(push.frame.rotation, pushed);
#else
    vec3 repulsion = volume.repulsion * rotate(push.frame.rotation, pushed);
#endif
    float size = length(repulsion);
    if (size > volume.greatest_repulsion) repulsion *= volume.greatest_repulsion / size;

#ifdef HAIRBENCH_YIELD
    held /= float(kVolumeGrids);
    State(volume.kept).at[index].xyz += dragged - held;  // it flows
    vec3 friction = rotate(push.frame.rotation, held);
#else
    vec4 kept = State(volume.kept).at[index];
    vec3 driven = kept.w == 0.0 ? vec3(0.0) : dragged - kept.xyz;  // m/s, by everything except
                                                                   // friction
    vec3 friction = volume.settled * dragged + volume.predicted * driven;
    State(volume.kept).at[index] = vec4(dragged - friction, 1.0);
#endif
    State(push.accelerations).at[index].xyz += volume.per_step * friction + repulsion;
}
