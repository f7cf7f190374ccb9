// The hairs that a strand stands for (strands/merged_word.glsl), for strands as points in memory.
#ifndef HAIRBENCH_POINTS_MERGED_GLSL
#define HAIRBENCH_POINTS_MERGED_GLSL

#include "common/picture.glsl"
#include "common/random.glsl"
#include "strands/merged_word.glsl"
#include "strands/patch.glsl"
#include "strands/points/layout.glsl"

// `stored` is the strand's entry of StrandPieces.
uint storedMerged(PictureParameters picture, uint strand, uint stored) {
    uint triangle = strand / picture.forced_density;
    uint key = hash(picture.seed, triangle, kRootPurpose);
    uint number = strandNumber(picture, triangle, strand % picture.forced_density);
    uint bits = hash(key, number, kMergedPurpose);
    return (stored & 0xffff0000u) | (bits >> 16u);
}

#endif
