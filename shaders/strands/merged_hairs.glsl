// What a strand of a coarser level of detail looks like from near by: the hairs that it stands for.
// They lie side by side, each in a cell of its own across the strip, narrower than the cell, and
// wander in it; each begins and ends at a place of its own. So the outline is not a sheet's, a hair
// has its own place across and its own direction, and what is behind is seen through the gaps. What
// they cover together is the width times the length of the strip as it would be without gaps.
#ifndef HAIRBENCH_MERGED_HAIRS_GLSL
#define HAIRBENCH_MERGED_HAIRS_GLSL

#include "common/random.glsl"
#include "strands/merged_word.glsl"

// The parts of a hair's length by which it begins later and ends earlier than the strip, at most.
const float kLateRoot = 0.06;
const float kEarlyTip = 0.14;
// How far a hair turns from the strip's direction: what directions of neighbouring hairs differ by.
const float kMergedTilt = 0.03;  // radians

// A hair of the strip at a place along it, in cells: cell 0 is in the middle.
struct MergedHair {
    float middle;  // across the strip
    float half_width;
    vec2 tilt;  // of its direction: across the strip, and towards the eye; radians
    bool there;  // neither before its root nor beyond its tip
};

// Where a place across the strip, -1 to 1, lies in cells.
float mergedPlace(uint word, float across) { return 0.5 * across * mergedCount(word) + 0.5; }

MergedHair mergedHair(uint word, float cell, float along) {
    uint bits = hash(word & 0xffffu, uint(int(cell)), kMergedPurpose);
    vec4 random = unpackUnorm4x8(bits);
    float part = mergedPart(word);
    float phase = 6.28318531 * (random.x + (0.4 + 0.8 * random.y) * along);
    // Hairs that are shorter in the mean are as much wider.
    float shorter = 1.0 - 0.5 * (kLateRoot + kEarlyTip) * part;
    MergedHair hair;
    hair.half_width = 0.5 / (mergedSpread(word) * shorter);
    hair.middle = cell + 0.5 + (0.5 - hair.half_width) * sin(phase);
    hair.tilt = kMergedTilt * part * vec2(cos(phase), 2.0 * random.z - 1.0);
    hair.there = along >= kLateRoot * part * random.z && along <= 1.0 - kEarlyTip * part * random.w;
    return hair;
}

// The place across the hair at a place of the strip: beyond -1 and 1 there is a gap.
float acrossMerged(MergedHair hair, float place) {
    return hair.there ? (place - hair.middle) / hair.half_width : 2.0;
}

bool isMergedGap(uint word, float across, float along) {
    if (mergedCount(word) == 1.0) return false;
    float place = mergedPlace(word, across);
    return abs(acrossMerged(mergedHair(word, floor(place), along), place)) > 1.0;
}

#endif
