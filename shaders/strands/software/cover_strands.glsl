// The samples that strands cover. An invocation has some strands, of which each point is fetched
// once. Pieces with many samples are left to cover_large.glsl.
#include "strands/software/cover.glsl"

layout(local_size_x = kSoftwareStrandGroup) in;

// Whether the piece is listed, to be covered by and by.
bool isListed(uint piece) {
    LargePieces large = LargePieces(push.large);
    if (push.choice > 0u) return large.count <= kMostLargePieces;
    uint place = atomicAdd(large.count, 1u);
    if (place >= kMostLargePieces) return false;
    large.at[place] = piece;
    return true;
}

void coverStrand(PictureParameters picture, uint strand, uint pieces) {
    PieceEnd from = pieceEnd(picture, loadPoint(push.points, firstPoint(strand, 0u, pieces)));
    for (uint i = 0u; i < kSegments * pieces; ++i) {
        uint first = firstPoint(strand, i, pieces);
        if (kSplitJoints == 1u && i > 0u && i % pieces == 0u)
            from = pieceEnd(picture, loadPoint(push.points, first));
        PieceEnd to = pieceEnd(picture, loadPoint(push.points, first + 1u));
        PieceQuad quad = pieceQuad(from, to);
        from = to;
        if (!quad.seen) continue;
        Cover cover = makeCover(quad);
        uint piece = strand * kPiecesPerStrand + i;
        float samples = float(cover.end - cover.begin) * (1.0 + cover.row_length);
        if (samples <= float(kManySamples) || !isListed(piece))
            coverRows(cover, cover.begin, 1, piece);
    }
}

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint begin = (group * gl_WorkGroupSize.x + gl_LocalInvocationID.x) * kBlock;
    uint end = min(begin + kBlock, push.strands);
    if (begin >= end) return;  // no barrier follows
    PictureParameters picture = PictureReference(push.picture).parameters;
    for (uint strand = begin; strand < end; ++strand) {
        uint pieces = StrandPieces(push.pieces).at[strand];
        if (pieces > 0u) coverStrand(picture, strand, pieces);
    }
}
