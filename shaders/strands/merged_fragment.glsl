// Maps a fragment of a strand that stands for many hairs to one of these hairs.
#ifndef HAIRBENCH_MERGED_FRAGMENT_GLSL
#define HAIRBENCH_MERGED_FRAGMENT_GLSL

#include "shading/strand_shading.glsl"
#include "strands/merged_hairs.glsl"

// Turns the strip's direction into the hair's direction.
void tilt(MergedHair hair, inout StrandFragment fragment) {
    vec3 side = unitSide(fragment.to_eye, fragment.tangent);
    vec3 facing = cross(fragment.tangent, side);
    fragment.tangent =
        normalize(fragment.tangent + hair.tilt.x * side + hair.tilt.y * facing);
}

// Converts the position across the strip to that across the hair. Returns false in a gap or beyond
// the hair's ends. Not for strands that stand for a single hair: they must stay unchanged, to the
// last bit.
bool toMergedHair(uint word, inout StrandFragment fragment) {
    float place = mergedPlace(word, fragment.across);
    MergedHair hair = mergedHair(word, floor(place), fragment.along);
    float across = acrossMerged(hair, place);
    fragment.across = clamp(across, -1.0, 1.0);
    tilt(hair, fragment);
    return abs(across) <= 1.0;
}

#endif
