// The Academy's film-like curve: Stephen Hill's fit of the reference rendering transform and the
// sRGB output transform of ACES 1.0 (published with Matt Pettineo's BakingLab, 2016). Unlike
// Narkowicz's fit of 2015, it works in ACES's own primaries, so bright colours fade to white.
#ifndef HAIRBENCH_TONE_MAP_ACES_GLSL
#define HAIRBENCH_TONE_MAP_ACES_GLSL

// Matrices are written row by row, so vectors go on their left. This one converts linear RGB with
// sRGB's primaries and white to ACEScg's (D60) and applies the transform's desaturation.
const mat3 kToAces = mat3(
    0.59719, 0.35458, 0.04823,
    0.07600, 0.90834, 0.01566,
    0.02840, 0.13383, 0.83777);

// Applies the output transform's desaturation and converts back to sRGB's primaries.
const mat3 kFromAces = mat3(
    1.60475, -0.53108, -0.07367,
    -0.10208, 1.10813, -0.00605,
    -0.00327, -0.07276, 1.07602);

// Maps linear scene light to linear display light, about [0, 1].
vec3 toneMapAces(vec3 light) {
    vec3 v = min(light * kToAces, vec3(65504.0));  // its square is finite
    vec3 fitted = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    return fitted * kFromAces;
}

#endif
