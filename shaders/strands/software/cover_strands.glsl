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

// Whether nothing of the piece can be seen: it is beside the picture, or behind what its tiles show.
bool isHidden(PieceQuad quad) {
    vec2 low = min(quad.from.place - abs(quad.from.side), quad.to.place - abs(quad.to.side));
    vec2 high = max(quad.from.place + abs(quad.from.side), quad.to.place + abs(quad.to.side));
    vec2 size = vec2(push.width, push.height);
    if (any(lessThan(high, vec2(0.0))) || any(greaterThanEqual(low, size))) return true;
    if (push.part == kCoverFirst) return false;
    uvec2 first = uvec2(max(low, vec2(0.0))) / kTile;
    uvec2 last = uvec2(min(high, size - 1.0)) / kTile;
    uvec2 count = last - first + 1u;
    if (count.x * count.y > kMostTiles) return false;
    uint near = nearness(depthRange(quad).y);
    uint begin = tileIndex(first);
    uint row = begin;
    uint end = tileIndex(last);
    for (uint i = begin; i <= end;) {
        if (TileDepths(push.tiles).at[i] >= near) return false;
        if (++i >= row + count.x) i = row = row + tileIndex(uvec2(0u, 1u));
    }
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
        if (!quad.seen || isHidden(quad)) continue;
        Cover cover = makeCover(quad);
        uint piece = strand * kPiecesPerStrand + i;
        float samples = float(cover.end - cover.begin) * (1.0 + cover.row_length);
        if (samples <= float(kManySamples) || !isListed(piece))
            coverRows(cover, cover.begin, 1, piece);
    }
}

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint block = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (push.part == kCoverFirst) block *= kFirstStrands;
    if (push.part == kCoverOthers) block += block / (kFirstStrands - 1u) + 1u;
    uint begin = block * kBlock;
    uint end = min(begin + kBlock, push.strands);
    if (begin >= end) return;  // no barrier follows
    PictureParameters picture = PictureReference(push.picture).parameters;
    for (uint strand = begin; strand < end; ++strand) {
        uint pieces = StrandPieces(push.pieces).at[strand];
        if (pieces > 0u) coverStrand(picture, strand, pieces);
    }
}
