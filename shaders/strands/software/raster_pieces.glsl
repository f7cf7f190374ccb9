// Rasterises the listed pieces of a part of the strands. Pieces with many samples are left to
// cover_large.glsl.
#include "strands/software/raster.glsl"

layout(local_size_x = kSoftwareStrandGroup) in;

// True if the piece is listed as a large one, which is rasterised later.
bool isLarge(uint piece) {
    Counts known = Counts(push.counts);
    if (push.choice > 0u) return known.counts.large <= kMostLargePieces;
    uint place = atomicAdd(known.counts.large, 1u);
    if (place >= kMostLargePieces) return false;
    PieceList(push.large).at[place] = piece;
    return true;
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
        float samples = float(raster.end - raster.begin) * (1.0 + raster.row_length);
        if (samples <= float(kLargePieceSamples) || !isLarge(piece))
            rasterizeRows(picture, raster, raster.begin, 1, piece);
    }
}
