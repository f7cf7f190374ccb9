// Layout of strands as points in memory, where each point is stored once.
#ifndef HAIRBENCH_POINTS_LAYOUT_GLSL
#define HAIRBENCH_POINTS_LAYOUT_GLSL

#include "common/extensions.glsl"
#include "shared/points_structs.h"
#include "strands/options.glsl"

layout(constant_id = kMostSegmentsConstant) const uint kSegments = 1;  // of a guide
layout(constant_id = kMostPiecesConstant) const uint kMostPieces = 1;  // of a segment

layout(buffer_reference, scalar) buffer StrandPieces { uint at[]; };

// Decodes an entry of StrandPieces: the number of pieces of a guide segment and, if merged hairs
// are drawn, the upper half of the strand's word of strands/merged_word.glsl.
uint piecesOf(uint word) { return kMergedHairs != 0 ? word & 0xffffu : word; }

layout(buffer_reference, scalar) buffer Bounds { HairBounds bounds; };

// If the width restarts in each guide segment, the points between two segments are stored twice.
const uint kSplitJoints = kTaper == kTaperSegment ? 1u : 0u;
const uint kPointsPerStrand =
    kSplitJoints == 1u ? kSegments * (kMostPieces + 1u) : kSegments * kMostPieces + 1u;
const uint kPiecesPerStrand = kSegments * kMostPieces;

// Returns the first point of a strand's piece, with `pieces` drawn pieces per segment.
uint firstPoint(uint strand, uint piece, uint pieces) {
    return strand * kPointsPerStrand + piece + (kSplitJoints == 1u ? piece / pieces : 0u);
}

#endif
