#version 460
// Rasterises the listed pieces of a part of the strands. Pieces with many samples are left to
// raster_large.comp.
#extension GL_GOOGLE_include_directive : require
#ifdef HAIRBENCH_TEXELS
#define kPointTexels 0
#define kVisibilityTexels 1
#endif
#include "strands/software/raster.glsl"

layout(local_size_x_id = kGroupConstant) in;

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
        else rasterizeRows(picture, raster, raster.begin, 1, piece);
    }
}
