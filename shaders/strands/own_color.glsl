// Colours of single strands, relative to the hair's colour.
#ifndef HAIRBENCH_OWN_COLOR_GLSL
#define HAIRBENCH_OWN_COLOR_GLSL

#include "common/picture.glsl"
#include "strands/merged_word.glsl"

// Factor on the hair's colour c at a position along a strand, 0 at the root and 1 at the tip. The
// resulting colour is c^a, as for hair that absorbs a times as much (Beer and Lambert). a is random
// for each strand, 1 - strand_variation to 1 + strand_variation, and decreases towards the tip by
// the fraction tip_lightening.
vec3 ownColor(PictureParameters picture, uint word, float along) {
    if (kOwnColors == 0u) return vec3(1.0);
    float place = float(word & 0xffffu) / 65535.0;
    float absorbs = 1.0 + picture.strand_variation * (2.0 * place - 1.0);
    absorbs *= 1.0 - picture.tip_lightening * along;
    return pow(max(picture.hair_color, vec3(1e-4)), vec3(absorbs - 1.0));
}

#endif
