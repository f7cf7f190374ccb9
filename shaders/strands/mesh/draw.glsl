// A work group draws a block of strands. It fetches the data of their roots, then their control
// points, then evaluates each point once. The quads of adjacent pieces share the point's two
// vertices. Include strands/quad_corner.glsl or shadows/quad_corner.glsl first, and define the
// layout of the outputs and putCorner(), which writes a vertex.
#ifndef HAIRBENCH_STRAND_MESH_GLSL
#define HAIRBENCH_STRAND_MESH_GLSL

#include "common/depth.glsl"
#include "strands/mesh/block.glsl"

layout(local_size_x_id = kMeshGroupConstant) in;

taskPayloadSharedEXT TaskPayload payload;

struct BlockStrand {
    uvec3 guides;
    vec3 weights;
    vec3 lift;
    StrandLod lod;
    uint drawn;  // 0: the level of detail omits it
};

// A strand has at least two points, and segments do not share their first points.
shared BlockStrand block_strands[kBlockPoints / 2u];
shared vec3 control_points[4u * kBlockPoints];  // [strand][segment][r(i-1) .. r(i+2)]

void fetchStrand(PictureParameters picture, StrandBlock block, uint number) {
    uint index = block.first_strand + number;
    StrandPatch strand_patch = patchOfStrand(picture, block.triangle, index);
    BlockStrand strand;
    strand.guides = patchGuides(picture, strand_patch);
    strand.weights = strandWeights(picture, strand_patch, index);
    strand.lift =
        strandLift(rootLift(picture, strand_patch, strand.guides), strand.weights);
    strand.lod = patchLod(picture, strand_patch, strand.guides);
    strand.drawn = index < drawnStrands(strand.lod) ? 1u : 0u;
    block_strands[number] = strand;
}

// `number` is an index of the block's segments.
void fetchSegment(PictureParameters picture, StrandBlock block, uint number) {
    uvec3 guides = block_strands[number / block.segments].guides;
    uint segment = block.first_segment + number % block.segments;
    vec3 points[12];
    for (int corner = 0; corner < 3; ++corner) {
        for (int k = 0; k < 4; ++k) {
            points[4 * corner + k] =
                guideControlPoint(picture, guides[corner], int(segment) + k - 1);
        }
    }
    vec3 r[4];
    strandControlPoints(picture, guides, segment, block_strands[number / block.segments].weights,
                        points, singleShares(picture, guides, segment), r);
    for (uint k = 0u; k < 4u; ++k) control_points[4u * number + k] = r[k];
}

// `number` is an index of the block's points, [strand][point].
void makePoint(PictureParameters picture, StrandBlock block, uint number) {
    uint points = pointsOf(block.segments, block.pieces);
    uint place = number % points;
    uint ends = block.pieces + kSplitJoints;  // points from the first of a segment to the first of
                                              // the next
    uint segment = min(place / ends, block.segments - 1u);
    BlockStrand block_strand = block_strands[number / points];

    StrandPatch strand_patch = patchOfStrand(picture, block.triangle,
                                             block.first_strand + number / points);
    strand_patch.segment = block.first_segment + segment;
    strand_patch.lod = block_strand.lod;
    PatchStrand strand;
    strand.index = block.first_strand + number / points;
    strand.guides = block_strand.guides;
    strand.weights = block_strand.weights;
    strand.lift = block_strand.lift;
    uint first_control = 4u * (number / points * block.segments + segment);
    for (uint k = 0u; k < 4u; ++k) strand.r[k] = control_points[first_control + k];
    // Pieces beyond those that are drawn have no length.
    StrandPoint point = drawnPoint(picture, strand_patch, strand,
                                   min(place - segment * ends, block_strand.lod.pieces));
    LineEnd end =
        LineEnd(point.position, point.tangent, point.width, point.along, point.merged);
    QuadEnd quad = quadEnd(picture, end);
    for (uint side = 0u; side < 2u; ++side) {
        QuadCorner corner = quadCorner(picture, end, quad, side == 0u ? -1.0 : 1.0);
        if (block_strand.drawn == 0u) corner.clip = kClippedPosition;
        putCorner(2u * number + side, corner);
    }
}

// `number` is an index of the block's pieces, [strand][piece].
void makePiece(StrandBlock block, uint number) {
    uint pieces = block.segments * block.pieces;
    uint place = number % pieces;
    uint point = number / pieces * pointsOf(block.segments, block.pieces) + place +
                 kSplitJoints * (place / block.pieces);
    uint corner = 2u * point;
    gl_PrimitiveTriangleIndicesEXT[2u * number] = uvec3(corner, corner + 1u, corner + 2u);
    gl_PrimitiveTriangleIndicesEXT[2u * number + 1u] =
        uvec3(corner + 1u, corner + 3u, corner + 2u);
}

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    StrandBlock block = strandBlock(picture, payload.blocks[gl_WorkGroupID.x]);
    uint points = block.strands * pointsOf(block.segments, block.pieces);
    uint pieces = block.strands * block.segments * block.pieces;
    SetMeshOutputsEXT(2u * points, 2u * pieces);

    uint local = gl_LocalInvocationIndex;
    uint size = gl_WorkGroupSize.x;
    for (uint i = local; i < block.strands; i += size) fetchStrand(picture, block, i);
    barrier();
    for (uint i = local; i < block.strands * block.segments; i += size)
        fetchSegment(picture, block, i);
    barrier();
    for (uint i = local; i < points; i += size) makePoint(picture, block, i);
    for (uint i = local; i < pieces; i += size) makePiece(block, i);
}

#endif
