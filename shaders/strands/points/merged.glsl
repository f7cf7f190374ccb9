// The hairs that a strand stands for (strands/merged_word.glsl), for strands as points in memory.
#ifndef HAIRBENCH_POINTS_MERGED_GLSL
#define HAIRBENCH_POINTS_MERGED_GLSL

#include "common/picture.glsl"
#include "common/random.glsl"
#include "strands/merged_word.glsl"
#include "strands/points/layout.glsl"

// `stored` is the strand's entry of StrandPieces.
uint storedMerged(PictureParameters picture, uint strand, uint stored) {
    uint key = hash(picture.seed, strand / picture.forced_density, kRootPurpose);
    uint bits = hash(key, strand % picture.forced_density, kMergedPurpose);
    return (stored & 0xffff0000u) | (bits >> 16u);
}

#endif
