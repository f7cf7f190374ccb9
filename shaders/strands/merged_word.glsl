// The number of hairs that a strand of a coarser level of detail stands for, as all stages store
// it.
#ifndef HAIRBENCH_MERGED_WORD_GLSL
#define HAIRBENCH_MERGED_WORD_GLSL

#include "shared/strand_structs.h"
#include "strands/options.glsl"

// A strand's hairs as a word: their number as a half float and 16 random bits.
uint mergedWord(float hairs, uint random_bits) {
    return packHalf2x16(vec2(0.0, max(hairs, 1.0))) | (random_bits >> 16u);
}

float mergedCount(uint word) { return unpackHalf2x16(word).y; }

// Grows from 0 for one hair to 1 for many. It scales every difference between the hairs and the
// strip, so that nothing jumps where a level begins.
float mergedPart(uint word) { return 1.0 - 1.0 / mergedCount(word); }

// Width of the strip relative to its width without gaps.
float mergedSpread(uint word) {
    return kMergedHairs != 0 ? mix(1.0, kMostMergedSpread, mergedPart(word)) : 1.0;
}

#endif
