// Strands as points in memory, each there once: where they are.
#ifndef HAIRBENCH_POINTS_LAYOUT_GLSL
#define HAIRBENCH_POINTS_LAYOUT_GLSL

#include "common/extensions.glsl"
#include "shared/points_structs.h"
#include "strands/options.glsl"

layout(constant_id = kMostSegmentsConstant) const uint kSegments = 1;  // of a guide
layout(constant_id = kMostPiecesConstant) const uint kMostPieces = 1;  // of a segment

layout(buffer_reference, scalar) buffer StrandPieces { uint at[]; };

// What StrandPieces has of a strand: pieces of a guide segment, and the upper half of its word of
// strands/merged_word.glsl where these are drawn.
uint piecesOf(uint word) { return kMergedHairs != 0 ? word & 0xffffu : word; }

layout(buffer_reference, scalar) buffer Bounds { HairBounds bounds; };

// Where the width starts anew in each guide segment, the points between two segments are there
// twice.
const uint kSplitJoints = kTaper == kTaperSegment ? 1u : 0u;
const uint kPointsPerStrand =
    kSplitJoints == 1u ? kSegments * (kMostPieces + 1u) : kSegments * kMostPieces + 1u;
const uint kPiecesPerStrand = kSegments * kMostPieces;

// The first point of a strand's piece, of which `pieces` are drawn a segment.
uint firstPoint(uint strand, uint piece, uint pieces) {
    return strand * kPointsPerStrand + piece + (kSplitJoints == 1u ? piece / pieces : 0u);
}

#endif
