#version 460
// Rasterises the listed pieces of a part of the strands, except those with many samples.
// HAIRBENCH_LARGE rasterises these: a work group shares the rows of a piece. If their list is full,
// they come from the lists of all pieces.
#extension GL_GOOGLE_include_directive : require
#ifdef HAIRBENCH_TEXELS
#define kPointTexels 0
#define kVisibilityTexels 1
#endif
#include "strands/software/raster.glsl"

layout(local_size_x_id = kGroupConstant) in;

#ifdef HAIRBENCH_LARGE
void main() {
    PieceCounts counts = Counts(push.counts).counts;
    bool listed = counts.large <= kMostLargePieces;
    uint first = counts.visible[kFirstPart];
    uint count = listed ? counts.large : first + counts.visible[kOtherPart];
    if (gl_WorkGroupID.x >= count) return;  // no barrier follows
    PictureParameters picture = PictureReference(push.picture).parameters;
    for (uint i = gl_WorkGroupID.x; i < count; i += gl_NumWorkGroups.x) {
        uint piece = listed ? PieceList(push.large).at[i]
                            : PieceList(push.list).at[i < first ? i : push.list_begin + i - first];
        PieceQuad quad = pieceOf(picture, piece).quad;
        if (!quad.visible) continue;
        RasterQuad raster = setUpQuad(quad);
        if (!listed && !isLarge(raster)) continue;
        RowShare share =
            shareOfGroup(raster, int(gl_LocalInvocationID.x), int(gl_WorkGroupSize.x));
        rasterizeRows(picture, raster, share, piece);
    }
}
#else
// Lists a large piece, which is rasterised later.
void listLarge(uint piece) {
    if (push.choice > 0u) return;  // they are listed
    uint place = atomicAdd(Counts(push.counts).counts.large, 1u);
    if (place < kMostLargePieces) PieceList(push.large).at[place] = piece;
}

void main() {
    uint count = Counts(push.counts).counts.visible[push.part];
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint place = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (place >= count) return;  // no barrier follows
    uint step = gl_NumWorkGroups.x * gl_NumWorkGroups.y * gl_WorkGroupSize.x;
    PictureParameters picture = PictureReference(push.picture).parameters;
    for (; place < count; place += step) {
        uint piece = PieceList(push.list).at[push.list_begin + place];
        PieceQuad quad = pieceOf(picture, piece).quad;
        if (!quad.visible) continue;
        RasterQuad raster = setUpQuad(quad);
        if (isLarge(raster)) listLarge(piece);
        else rasterizeRows(picture, raster, kWholePiece, piece);
    }
}
#endif
