#version 460
// Rasterises the large pieces. A work group shares the rows of a piece. If their list is full, the
// pieces come from the lists of all pieces.
#extension GL_GOOGLE_include_directive : require
#ifdef HAIRBENCH_TEXELS
#define kPointTexels 0
#define kVisibilityTexels 1
#endif
#include "strands/software/raster.glsl"

layout(local_size_x_id = kGroupConstant) in;

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
        rasterizeRows(picture, raster, raster.begin + int(gl_LocalInvocationID.x),
                      int(gl_WorkGroupSize.x), piece);
    }
}
