// The point of a piece that is seen at a screen position.
#ifndef HAIRBENCH_SOFTWARE_PLACE_GLSL
#define HAIRBENCH_SOFTWARE_PLACE_GLSL

#include "strands/points/merged.glsl"
#include "strands/software/software.glsl"

#include "strands/merged_hairs.glsl"
#include "strands/points/quad.glsl"

struct PieceCoordinates {
    float t;  // 0 at its first end, 1 at its second
    float across;  // -1 to 1
    bool second;  // true on the second of its triangles
};

// Returns the factors of two vectors with corner + x.x first + x.y second = 0.
vec2 barycentrics(vec2 corner, vec2 first, vec2 second) {
    float area = cross2(first, second);
    return vec2(cross2(second, corner), cross2(corner, first)) / (abs(area) < 1e-30 ? 1e-30 : area);
}

// Returns the point that is seen at a screen position, px. It is on one of the two triangles that
// other back ends draw: the first from -+ side at the first end to - side at the second, the other
// the rest.
PieceCoordinates pieceCoordinates(Piece piece, vec2 place) {
    // Differences from this place in clip space, which the seen point has at 0.
    vec2 clip = 2.0 * place / vec2(push.width, push.height) - 1.0;
    vec2 from = piece.from.middle_clip.xy - clip * piece.from.middle_clip.w;
    vec2 from_side = piece.from.side_clip.xy - clip * piece.from.side_clip.w;
    vec2 to = piece.to.middle_clip.xy - clip * piece.to.middle_clip.w;
    vec2 to_side = piece.to.side_clip.xy - clip * piece.to.side_clip.w;
    vec2 along_and_across =
        barycentrics(from - from_side, to - to_side - from + from_side, 2.0 * from_side);
    PieceCoordinates at;
    at.second = along_and_across.x + along_and_across.y > 1.0;
    if (at.second)
        along_and_across =
            1.0 - barycentrics(to + to_side, from + from_side - to - to_side, -2.0 * to_side);
    at.t = clamp(along_and_across.x, piece.quad.part.x, piece.quad.part.y);
    at.across = clamp(2.0 * along_and_across.y - 1.0, -1.0, 1.0);
    return at;
}

// The position across at the seen point, allowing for a width that changes along the piece.
float perspectiveAcross(Piece piece, PieceCoordinates at) {
    float from = length(piece.from.side);
    float to = length(piece.to.side);
    float offset = at.second ? at.across * to + (1.0 - at.t) * (from - to)
                               : at.across * from + at.t * (from - to);
    return clamp(offset / max(mix(from, to, at.t), 1e-12), -1.0, 1.0);
}

// The strand of a piece by its number: the hairs that it stands for, and the position along it.
struct PlaceOnStrand {
    uint merged;
    float along;  // 0 at the root, 1 at the tip
};

PlaceOnStrand placeOnStrand(PictureParameters picture, uint number, float t) {
    uint strand = number / kPointsPerStrand;
    uint stored = StrandPieces(push.pieces).at[strand];
    uint pieces = piecesOf(stored);
    uint point = number % kPointsPerStrand;
    float segment = float(point / (pieces + kSplitJoints));
    float end = float(point % (pieces + kSplitJoints));
    return PlaceOnStrand(storedMerged(picture, strand, stored),
                         (segment + (end + t) / float(pieces)) / float(kSegments));
}

// True if a screen position, px, is in a gap between the hairs that the piece's strand stands for.
bool isGap(PictureParameters picture, uint piece, vec2 place) {
    Piece covered = pieceOf(picture, piece);
    PieceCoordinates at = pieceCoordinates(covered, place);
    PlaceOnStrand on_strand = placeOnStrand(picture, piece, at.t);
    return isMergedGap(on_strand.merged, perspectiveAcross(covered, at), on_strand.along);
}

#endif
