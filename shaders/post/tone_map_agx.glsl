// Troy Sobotka's AgX (2022) with the primaries and matrices of Eary Chow's version in Blender 4.0,
// which Filament and three.js use too. They fit the curve with a polynomial; this is the exact
// curve.
#ifndef HAIRBENCH_TONE_MAP_AGX_GLSL
#define HAIRBENCH_TONE_MAP_AGX_GLSL

// Matrices are written row by row, so vectors go on their left.
// Matrices from sRGB's primaries to Rec. 2020 and back (ITU-R BT.2087-0). The inset draws the
// primaries in towards white, so that bright colours fade to white; the outset undoes it.
const mat3 kToRec2020 = mat3(
    0.6274039, 0.3292830, 0.0433131,
    0.0690973, 0.9195404, 0.0113623,
    0.0163914, 0.0880133, 0.8955953);
const mat3 kFromRec2020 = mat3(
    1.6604910, -0.5876411, -0.0728499,
    -0.1245505, 1.1328999, -0.0083494,
    -0.0181508, -0.1005789, 1.1187297);
const mat3 kAgxInset = mat3(
    0.856627153315983, 0.0951212405381588, 0.0482516061458583,
    0.137318972929847, 0.761241990602591, 0.101439036467562,
    0.11189821299995, 0.0767994186031903, 0.811302368396859);
const mat3 kAgxOutset = mat3(
    1.1271005818144368, -0.11060664309660323, -0.016493938717834573,
    -0.1413297634984383, 1.157823702216272, -0.016493938717834257,
    -0.14132976349843826, -0.11060664309660294, 1.2519364065950405);

const float kAgxGrey = 0.18;
const vec2 kAgxStops = vec2(-10.0, 6.5);  // black and white, relative to the grey
const vec2 kAgxPivot = vec2(10.0 / 16.5, 0.5);  // input and output of the grey
const float kAgxSlope = 2.0;  // at the pivot
const vec2 kAgxPowers = vec2(3.0, 3.25);  // of the toe and the shoulder

// Half of the curve, from the pivot, where its slope is kAgxSlope, to `reach`, where it levels off.
// `away` is the distance from the pivot, in [0, reach.x].
float agxHalf(float away, vec2 reach, float power) {
    float steep = kAgxSlope * reach.x;
    float scale = steep * pow(pow(steep / reach.y, power) - 1.0, -1.0 / power);
    float t = kAgxSlope * away / scale;
    return scale * t * pow(1.0 + pow(t, power), -1.0 / power);
}

// Maps stops scaled to [0, 1] to a display value encoded with a power of 2.2, in [0, 1].
float agxCurve(float x) {
    if (x < kAgxPivot.x)
        return kAgxPivot.y - agxHalf(kAgxPivot.x - x, kAgxPivot, kAgxPowers.x);
    return kAgxPivot.y + agxHalf(x - kAgxPivot.x, vec2(1.0) - kAgxPivot, kAgxPowers.y);
}

// Maps linear scene light to linear display light, about [0, 1].
vec3 toneMapAgx(vec3 light) {
    vec3 inset = light * kToRec2020 * kAgxInset;
    vec3 stops = log2(max(inset, vec3(1e-10)) / kAgxGrey);
    vec3 x = clamp((stops - kAgxStops.x) / (kAgxStops.y - kAgxStops.x), 0.0, 1.0);
    vec3 curved = vec3(agxCurve(x.r), agxCurve(x.g), agxCurve(x.b)) * kAgxOutset;
    return pow(max(curved, vec3(0.0)), vec3(2.2)) * kFromRec2020;
}

#endif
