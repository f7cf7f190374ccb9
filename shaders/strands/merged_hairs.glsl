// The close-up look of a strand of a coarser level of detail: the hairs that it stands for. They
// lie side by side, each in its own cell across the strip. A hair is narrower than its cell,
// wanders in it, and has its own start and end. The strip therefore does not look like a sheet:
// each hair has its own position and direction, and the background shows through the gaps. The
// hairs together cover the width times the length of the strip without gaps.
#ifndef HAIRBENCH_MERGED_HAIRS_GLSL
#define HAIRBENCH_MERGED_HAIRS_GLSL

#include "common/random.glsl"
#include "strands/merged_word.glsl"

// The greatest fractions of the length by which a hair begins later and ends earlier than the
// strip.
const float kLateRoot = 0.06;
const float kEarlyTip = 0.14;
// Greatest angle between a hair and the strip, like the difference between the directions of
// neighbouring hairs.
const float kMergedTilt = 0.03;  // radians

// A hair of the strip at a position along it, in cells. Cell 0 is in the middle.
struct MergedHair {
    float middle;  // across the strip
    float half_width;
    vec2 tilt;  // of its direction: across the strip and towards the eye; radians
    bool there;  // false before its root and beyond its tip
};

// Converts a position across the strip, -1 to 1, to cells.
float mergedPlace(uint word, float across) { return 0.5 * across * mergedCount(word) + 0.5; }

MergedHair mergedHair(uint word, float cell, float along) {
    uint bits = hash(word & 0xffffu, uint(int(cell)), kMergedPurpose);
    vec4 random = unpackUnorm4x8(bits);
    float part = mergedPart(word);
    float phase = 6.28318531 * (random.x + (0.4 + 0.8 * random.y) * along);
    // Hairs that are shorter on average are wider in compensation.
    float shorter = 1.0 - 0.5 * (kLateRoot + kEarlyTip) * part;
    MergedHair hair;
    hair.half_width = 0.5 / (mergedSpread(word) * shorter);
    hair.middle = cell + 0.5 + (0.5 - hair.half_width) * sin(phase);
    hair.tilt = kMergedTilt * part * vec2(cos(phase), 2.0 * random.z - 1.0);
    hair.there = along >= kLateRoot * part * random.z && along <= 1.0 - kEarlyTip * part * random.w;
    return hair;
}

// The position across the hair at a position across the strip. There is a gap beyond -1 and 1.
float acrossMerged(MergedHair hair, float place) {
    return hair.there ? (place - hair.middle) / hair.half_width : 2.0;
}

bool isMergedGap(uint word, float across, float along) {
    if (mergedCount(word) == 1.0) return false;
    float place = mergedPlace(word, across);
    return abs(acrossMerged(mergedHair(word, floor(place), along), place)) > 1.0;
}

#endif
