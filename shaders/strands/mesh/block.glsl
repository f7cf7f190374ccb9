// Blocks of the back end `mesh`. A mesh work group draws one block: as many strands of a root
// triangle as have points that fit, or some whole segments of a longer strand.
#ifndef HAIRBENCH_STRAND_BLOCK_GLSL
#define HAIRBENCH_STRAND_BLOCK_GLSL

#include "strands/strand.glsl"

#include "shared/strand_mesh_structs.h"

layout(constant_id = kMostSegmentsConstant) const uint kSegments = 1;  // of a guide
layout(constant_id = kMostPiecesConstant) const uint kMostPieces = 1;  // of a segment
layout(constant_id = kBlockPointsConstant) const uint kBlockPoints = kMeshVertices / 2u;
layout(constant_id = kTaskGroupConstant) const uint kTaskGroup = 1;  // invocations, one block each

layout(push_constant, scalar) uniform Push { StrandMeshPush push; };

// The blocks that a task work group passes on.
struct TaskPayload {
    uint blocks[kTaskGroup];
};

// If the width restarts in each guide segment, the points between two segments are stored twice.
const uint kSplitJoints = kTaper == kTaperSegment ? 1u : 0u;

uint pointsOf(uint segments, uint pieces) {
    return segments * (pieces + kSplitJoints) + 1u - kSplitJoints;
}

// The division of strands into blocks, for a number of pieces per segment.
struct BlockCut {
    uint strands;   // per block
    uint parts;     // blocks per strand
    uint segments;  // per part
};

BlockCut blockCut(uint pieces) {
    uint most = (kBlockPoints - 1u + kSplitJoints) / (pieces + kSplitJoints);
    BlockCut cut;
    cut.strands = max(kBlockPoints / pointsOf(kSegments, pieces), 1u);
    cut.parts = (kSegments + most - 1u) / most;
    cut.segments = (kSegments + cut.parts - 1u) / cut.parts;
    return cut;
}

struct StrandBlock {
    uint triangle;
    uint first_strand;  // of the triangle
    uint strands;       // 0: the level of detail draws none of the block
    uint first_segment;
    uint segments;
    uint pieces;  // pieces per segment for which there is room
};

// Returns the patch of a strand's first segment.
StrandPatch patchOfStrand(PictureParameters picture, uint triangle, uint strand) {
    uint part = triangle * picture.patches_per_triangle + strand / picture.strands_per_patch;
    return strandPatch(picture, part * kSegments);
}

// Blocks are numbered [triangle][strands][part], with the count of the finest level. At coarser
// levels more strands fit a block, so the last blocks of a triangle are empty. Strands of a groom
// have their own levels, so their blocks have room for the finest level.
StrandBlock strandBlock(PictureParameters picture, uint index) {
    BlockCut cut = blockCut(kMostPieces);
    uint blocks = (picture.forced_density + cut.strands - 1u) / cut.strands * cut.parts;
    StrandBlock block;
    block.triangle = index / blocks;
    block.pieces = kMostPieces;
    uint drawn = picture.forced_density;
    if (kLodMode != kLodForced && kSource != kSourceGroom) {
        StrandPatch strand_patch = patchOfStrand(picture, block.triangle, 0u);
        StrandLod lod = patchLod(picture, strand_patch, patchGuides(picture, strand_patch));
        block.pieces = lod.pieces;
        drawn = drawnStrands(lod);
        cut = blockCut(lod.pieces);
    }
    uint number = index % blocks;
    block.first_strand = number / cut.parts * cut.strands;
    block.strands = drawn > block.first_strand ? min(drawn - block.first_strand, cut.strands) : 0u;
    block.first_segment = number % cut.parts * cut.segments;
    block.segments = min(cut.segments, kSegments - block.first_segment);
    return block;
}

#endif
