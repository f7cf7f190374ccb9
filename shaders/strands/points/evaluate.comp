#version 460
// Evaluates each point of the strands once, and finds the part of the picture that they touch. An
// invocation has some strands of a root triangle and a run of their segments, along which it slides
// a window of the guides' control points. All segments are whole runs.
#extension GL_GOOGLE_include_directive : require
#include "common/vectors.glsl"

#include "strands/outside.glsl"
#include "strands/points/layout.glsl"
#include "strands/strand.glsl"

layout(constant_id = kStrandBlockConstant) const uint kBlock = 1;  // strands per invocation
layout(constant_id = kSegmentRunConstant) const uint kSegmentRun = 1;  // segments per invocation

layout(push_constant, scalar) uniform Push { PointsPush push; };

#include "strands/pixel_margin.glsl"
#include "strands/points/quad.glsl"

layout(local_size_x_id = kGroupConstant) in;

// Extent of the corners so far, px.
struct Extent {
    vec2 low;
    vec2 high;
};

void widen(inout Extent extent, PieceEnd end) {
    if (end.beyond <= 0.0) {
        // A piece that crosses the near plane may reach anywhere.
        extent = Extent(vec2(0.0), vec2(push.width, push.height));
        return;
    }
    extent.low = min(extent.low, end.projected.place - abs(end.projected.side));
    extent.high = max(extent.high, end.projected.place + abs(end.projected.side));
}

// Bounds rarely grow, so most strands only read them.
void mergeBounds(Extent extent) {
    vec2 size = vec2(push.width, push.height);
    uvec2 low = uvec2(clamp(floor(extent.low), vec2(0.0), size));
    uvec2 high = uvec2(clamp(ceil(extent.high), vec2(0.0), size));
    if (any(greaterThanEqual(low, high))) return;
    Bounds reference = Bounds(push.bounds);
    HairBounds seen = reference.bounds;
    uint from_right = push.width - low.x;
    uint from_bottom = push.height - low.y;
    if (from_right > seen.from_right) atomicMax(reference.bounds.from_right, from_right);
    if (from_bottom > seen.from_bottom) atomicMax(reference.bounds.from_bottom, from_bottom);
    if (high.x > seen.right) atomicMax(reference.bounds.right, high.x);
    if (high.y > seen.bottom) atomicMax(reference.bounds.bottom, high.y);
}

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint invocation = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    const uint runs = kSegments / kSegmentRun;  // of a strand
    uint block = invocation / runs;
    uint first_segment = invocation % runs * kSegmentRun;
    PictureParameters picture = PictureReference(push.picture).parameters;
    uint blocks = (picture.forced_density + kBlock - 1u) / kBlock;  // of a triangle
    uint triangle = block / blocks;
    uint begin = block % blocks * kBlock;
    uint end = min(begin + kBlock, picture.forced_density);
    uint number = triangle * picture.forced_density + begin;
    if (number >= push.strands) return;  // no barrier follows

    uint part = triangle * picture.patches_per_triangle + begin / picture.strands_per_patch;
    StrandPatch strand_patch = strandPatch(picture, part * kSegments);
    uvec3 guides = patchGuides(picture, strand_patch);
    strand_patch.lod = patchLod(picture, strand_patch, guides);
    uint pieces = strand_patch.lod.pieces;
    uint drawn = min(drawnStrands(strand_patch.lod), end);
    if (push.culls != 0u) {
        float offset = 0.0;
        if (kSource == kSourceGroom) offset = boundReach(picture, begin);
        float beyond =
            push.reach + offset + push.greatest_width * strand_patch.lod.width_scale;
        if (isOutsideFrustum(picture, guides, 0u, kSegments, beyond)) drawn = begin;
    }
    for (uint index = begin; index < end && first_segment == 0u; ++index) {
        uint word = pieces;
        if (kMergedHairs != 0)
            word |= strandMerged(picture, strand_patch, index) & 0xffff0000u;
        StrandPieces(push.pieces).at[number + index - begin] = index < drawn ? word : 0u;
    }
    if (drawn <= begin) return;

    RootLift lift = rootLift(picture, strand_patch, guides);
    vec3 controls[12];
    for (int corner = 0; corner < 3; ++corner) {
        for (int k = 0; k < 4; ++k)
            controls[4 * corner + k] =
                guideControlPoint(picture, guides[corner], int(first_segment) + k - 1);
    }
    Extent extent = Extent(vec2(1e9), vec2(-1e9));
    PatchStrand strand;
    strand.guides = guides;
    for (uint turn = 0u; turn < kSegmentRun; ++turn) {
        uint segment = first_segment + turn;
        strand_patch.segment = segment;
        vec4 shares = singleShares(picture, guides, segment);
        for (uint i = 0u; i < kBlock; ++i) {
            strand.index = begin + i;
            if (strand.index >= drawn) break;
            strand.weights = strandWeights(picture, strand_patch, strand.index);
            strand.lift = strandLift(lift, strand.weights);
            strandControlPoints(
                picture, guides, segment, strand.weights, controls, shares, strand.r);
            uint first = (number + strand.index - begin) * kPointsPerStrand +
                         segment * (pieces + kSplitJoints);
            // A segment's first point is the last of the previous segment, unless joints are split.
            for (uint end = segment == 0u ? 0u : 1u - kSplitJoints; end <= pieces; ++end) {
                StrandPoint point = drawnPoint(picture, strand_patch, strand, end);
                float width = point.width;
                if (kMergedHairs != 0) width *= mergedSpread(point.merged);
                PackedPoint kept = PackedPoint(point.position, point.tangent, width);
                storePoint(push.points, first + end, kept);
                widen(extent, pieceEnd(picture, kept));
            }
        }
        if (turn + 1u == kSegmentRun) break;
        for (int corner = 0; corner < 3; ++corner) {
            for (int k = 0; k < 3; ++k) controls[4 * corner + k] = controls[4 * corner + k + 1];
            controls[4 * corner + 3] =
                guideControlPoint(picture, guides[corner], int(min(segment + 3u, kSegments + 1u)));
        }
    }
    mergeBounds(extent);
}
