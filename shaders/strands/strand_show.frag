#version 460
// A strand's quad, opaque, in a color that says something of it: /render/show.
#extension GL_GOOGLE_include_directive : require
#include "common/display_color.glsl"
#include "common/perceptual_color.glsl"
#include "strands/fragment.glsl"

layout(location = 0) out vec4 color;

// Fragments at which red, green and blue are full, of those that are added up.
const vec3 kFull = vec3(8.0, 32.0, 128.0);
const float kRed = 0.5;  // hues
const float kBlue = 4.5;
const float kTurn = 6.283185307;

// A direction's components from -1 to 1 as red, green and blue of a display.
vec3 directionColor(vec3 direction) { return 0.5 + 0.5 * direction; }

// Working colors; where they are display RGB, what is linear is made so.
vec3 fromLinear(vec3 linear) { return kLinearLight != 0 ? linear : toDisplay(linear); }
vec3 fromDisplay(vec3 display) {
    if (kLinearLight == 0) return display;
    return mix(pow((display + 0.055) / 1.055, vec3(2.4)), display / 12.92,
               lessThanEqual(display, vec3(0.04045)));
}

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    StrandFragment fragment = seenStrand(picture).fragment;
    float shown = fragment.along;  // strands/strand.glsl puts it there
    vec3 result;
    float alpha = 1.0;
    if (kShow == kShowTangents) {
        result = fromDisplay(directionColor(fragment.tangent));
    } else if (kShow == kShowNormals) {
        result = fromDisplay(directionColor(cylinderNormal(fragment)));
    } else if (kShow == kShowOverdraw || kShow == kShowDensity) {
        result = 1.0 / kFull;
        alpha = 0.0;  // that of what they are added to stays
    } else if (kShow == kShowShadow) {
        float visible = 0.0;
        for (uint i = 0u; i < kLightCount; ++i)
            visible += visiblePart(picture, i, fragment) / float(kLightCount);
        result = fromDisplay(vec3(kLightCount == 0u ? 1.0 : visible));
    } else if (kShow == kShowLod) {
        float hue = mix(kBlue, kRed, clamp(shown, 0.0, 1.0));
        result = fromLinear(perceptualColor(0.65, 0.16, hue));
    } else {
        float lightness = mix(0.45, 0.85, fract(shown * 16.0));
        result = fromLinear(perceptualColor(lightness, 0.15, shown * kTurn));
    }
    color = vec4(result, alpha);
}
