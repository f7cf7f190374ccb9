// The vertices of a line list. Each one evaluates its own point. Lines are numbered
// [patch][isoline][piece], with the counts of the finest level, in the order of the tessellation
// back end.
#ifndef HAIRBENCH_LINE_LIST_GLSL
#define HAIRBENCH_LINE_LIST_GLSL

#include "strands/strand.glsl"

// `drawn` tells whether the line belongs to a strand.
StrandPoint listedPoint(PictureParameters picture, uint vertex, out bool drawn) {
    uint line = vertex / 2u;
    uint tessellation = kLodMode == kLodForced ? picture.forced_tessellation : picture.tessellation;
    uint piece = line % tessellation;
    uint isoline = line / tessellation % picture.strands_per_patch;

    StrandPatch strand_patch =
        strandPatch(picture, line / tessellation / picture.strands_per_patch);
    uvec3 guides = patchGuides(picture, strand_patch);
    strand_patch.lod = patchLod(picture, strand_patch, guides);
    drawn = isoline < strandsInPatch(picture, strand_patch) && piece < strand_patch.lod.pieces;
    return pointFromGuides(picture, strand_patch, guides, strand_patch.first_strand + isoline,
                           piece + vertex % 2u);
}

#endif
