// Colours of single strands, relative to the hair's colour.
#ifndef HAIRBENCH_OWN_COLOR_GLSL
#define HAIRBENCH_OWN_COLOR_GLSL

#include "common/picture.glsl"
#include "strands/merged_word.glsl"

// Sums are precise, as all sums in the shaders that place strands.

// Mean power over the strands at this position along them, 0 at the root and 1 at the tip. It
// decreases towards the tip by the fraction tip_lightening.
float meanPower(PictureParameters picture, float along) {
    precise float power = 1.0 - picture.tip_lightening * along;
    return kOwnColors == 0u ? 1.0 : power;
}

// The power a of a strand: its colour is c^a, where c is the hair's colour. a is random for each
// strand, 1 - strand_variation to 1 + strand_variation times the mean. By equation (9) of Chiang et
// al. 2016, ln c = -k sqrt(sigma_a), its absorption is a^2 times the hair's.
float ownPower(PictureParameters picture, uint word, float along) {
    if (kOwnColors == 0u) return 1.0;
    float place = float(word & 0xffffu) / 65535.0;
    precise float factor = 1.0 + picture.strand_variation * (2.0 * place - 1.0);
    return meanPower(picture, along) * factor;
}

// Factor on the hair's colour that makes it c^power.
vec3 ownColor(PictureParameters picture, float power) {
    if (kOwnColors == 0u) return vec3(1.0);
    return pow(max(picture.hair_color, vec3(1e-4)), vec3(power - 1.0));
}

#endif
