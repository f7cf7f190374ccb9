// Rasterises the listed large pieces. A work group shares the rows of a piece.
#include "strands/software/raster.glsl"

layout(local_size_x = kSoftwareStrandGroup) in;

void main() {
    uint count = min(Counts(push.counts).counts.large, kMostLargePieces);
    if (gl_WorkGroupID.x >= count) return;  // no barrier follows
    PictureParameters picture = PictureReference(push.picture).parameters;
    for (uint i = gl_WorkGroupID.x; i < count; i += gl_NumWorkGroups.x) {
        uint piece = PieceList(push.large).at[i];
        RasterQuad raster = setUpQuad(pieceOf(picture, piece).quad);
        rasterizeRows(picture, raster, raster.begin + int(gl_LocalInvocationID.x),
                  int(gl_WorkGroupSize.x), piece);
    }
}
