#version 460
// Rasterises strands in a light's map in compute, from their points, as depth.frag and opacity.frag
// do: first the nearest depth of each texel, then opacity in layers behind it. An invocation has
// some segments of a strand. HAIRBENCH_LARGE is for pieces with many samples, whose rows a work
// group shares.
#extension GL_GOOGLE_include_directive : require
#ifdef HAIRBENCH_TEXELS
#define kPointTexels 1
#endif
#include "common/picture.glsl"
#include "shared/shadow_structs.h"
#include "strands/points/layout.glsl"

layout(push_constant, scalar) uniform Push { ShadowRasterPush push; };

#include "shadows/layers.glsl"
#include "shadows/quad_corner.glsl"
#include "strands/points/merged.glsl"
#include "strands/software/rows.glsl"

layout(constant_id = kSegmentRunConstant) const uint kRun = 1;  // segments per invocation
layout(local_size_x_id = kGroupConstant) in;

layout(binding = 0) uniform sampler2D mesh_depths;
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer ShadowMapReference { ShadowMap map; };
layout(buffer_reference, scalar) buffer Words { uint at[]; };

struct MapEnd {
    PieceEnd end;
    float coverage;
};

// The values of the piece and of the map for takeSample().
float piece_coverage;
ShadowMap light_map;

void takeSample(PictureParameters picture, uint piece, uvec2 texel, uint index, vec2 place,
                float depth) {
    uint at = texel.y * push.width + texel.x;
    uint bits = floatBitsToUint(notBeyondFar(depth));
    if (push.choice == 0u) {
        if (bits > Words(push.depths).at[at]) atomicMax(Words(push.depths).at[at], bits);
        return;
    }
    // For deep_shadow, light ends at a mesh.
    if (light_map.ends_at_meshes != 0u) {
        ivec2 in_atlas = ivec2(light_map.corner) + ivec2(texel);
        if (isNearer(texelFetch(mesh_depths, in_atlas, 0).r, depth)) return;
    }
    float nearest = uintBitsToFloat(Words(push.depths).at[at]);
    float behind =
        viewDepth(light_map.depth_terms, depth) - viewDepth(light_map.depth_terms, nearest);
    // Each strand is counted in its own layer; store.comp adds it to those behind.
    uint layer = 4u - uint(dot(layersOf(behind, light_map.layer_depth), vec4(1.0)));
    atomicAdd(Words(push.layers).at[4u * at + layer], uint(round(piece_coverage / kCoverageUnit)));
}

MapEnd mapEnd(PictureParameters picture, uint merged, uint number) {
    PackedPoint point = loadPoint(push.points, number);
    // Stored points have the drawn width, including gaps.
    LineEnd line = LineEnd(point.position, point.tangent, point.width / mergedSpread(merged), 0.0,
                           merged);
    QuadEnd quad = quadEnd(picture, line);
    return MapEnd(pieceEnd(picture, point, quad.side), quad.coverage);
}

// Sets up the piece between two points; returns false if nothing of it is in the map.
bool setUpPiece(MapEnd from, MapEnd to, out RasterQuad raster) {
    PieceQuad quad = pieceQuad(from.end, to.end);
    if (!quad.visible) return false;
    raster = setUpQuad(quad);
    piece_coverage = 0.5 * (from.coverage + to.coverage);
    return true;
}

uint mergedOf(PictureParameters picture, uint strand) {
    if (!kTellsHairs) return 0u;
    return storedMerged(picture, strand, StrandPieces(push.pieces).at[strand]);
}

#ifdef HAIRBENCH_LARGE
void rasterizeLarge(PictureParameters picture, uint number, bool listed) {
    uint merged = mergedOf(picture, number / kPointsPerStrand);
    MapEnd from = mapEnd(picture, merged, number);
    MapEnd to = mapEnd(picture, merged, number + 1u);
    RasterQuad raster;
    if (!setUpPiece(from, to, raster)) return;
    if (!listed && !isLarge(raster)) return;
    RowShare share =
        shareOfGroup(raster, int(gl_LocalInvocationID.x), int(gl_WorkGroupSize.x));
    rasterizeRows(picture, raster, share, number);
}

void main() {
    uint count = Words(push.large).at[0];
    bool listed = count <= kMostLargePieces;
    if (!listed) count = push.strands * kPiecesPerStrand;
    if (gl_WorkGroupID.x >= count) return;  // no barrier follows
    PictureParameters picture = PictureReference(push.picture).parameters;
    light_map = ShadowMapReference(picture.shadows).map;
    for (uint i = gl_WorkGroupID.x; i < count; i += gl_NumWorkGroups.x) {
        uint number = listed ? Words(push.large).at[1u + i] : 0u;
        if (!listed) {
            uint strand = i / kPiecesPerStrand;
            uint pieces = piecesOf(StrandPieces(push.pieces).at[strand]);
            if (i % kPiecesPerStrand >= kSegments * pieces) continue;
            number = firstPoint(strand, i % kPiecesPerStrand, pieces);
        }
        rasterizeLarge(picture, number, listed);
    }
}
#else
void listLarge(uint number) {
    if (push.choice > 0u) return;  // they are listed
    uint place = atomicAdd(Words(push.large).at[0], 1u);
    if (place < kMostLargePieces) Words(push.large).at[1u + place] = number;
}

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint place = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    const uint runs = (kSegments + kRun - 1u) / kRun;
    uint strand = place / runs;
    if (strand >= push.strands) return;  // no barrier follows
    uint pieces = piecesOf(StrandPieces(push.pieces).at[strand]);
    if (pieces == 0u) return;
    PictureParameters picture = PictureReference(push.picture).parameters;
    light_map = ShadowMapReference(picture.shadows).map;
    uint merged = mergedOf(picture, strand);
    uint begin = place % runs * kRun * pieces;
    uint end = min(begin + kRun * pieces, kSegments * pieces);
    MapEnd from;
    for (uint i = begin; i < end; ++i) {
        uint first = firstPoint(strand, i, pieces);
        if (i == begin || (kSplitJoints == 1u && i % pieces == 0u))
            from = mapEnd(picture, merged, first);
        MapEnd to = mapEnd(picture, merged, first + 1u);
        RasterQuad raster;
        if (setUpPiece(from, to, raster)) {
            if (isLarge(raster)) listLarge(first);
            else rasterizeRows(picture, raster, kWholePiece, first);
        }
        from = to;
    }
}
#endif
