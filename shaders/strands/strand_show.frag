#version 460
// Draws a strand's quad, opaque, in a colour that visualises a property of it: /render/show.
#extension GL_GOOGLE_include_directive : require
#include "common/display_color.glsl"
#include "common/perceptual_color.glsl"
#include "strands/fragment.glsl"

layout(location = 0) out vec4 color;

// Numbers of added fragments at which red, green and blue saturate.
const vec3 kFull = vec3(8.0, 32.0, 128.0);
const float kRed = 0.5;  // hues
const float kBlue = 4.5;
const float kTurn = 6.283185307;

// Maps a direction's components from -1 to 1 to red, green and blue of a display.
vec3 directionColor(vec3 direction) { return 0.5 + 0.5 * direction; }

// Convert to working colours, which are linear or display RGB.
vec3 fromLinear(vec3 linear) { return kLinearLight != 0 ? linear : toDisplay(linear); }
vec3 fromDisplay(vec3 display) {
    if (kLinearLight == 0) return display;
    return mix(pow((display + 0.055) / 1.055, vec3(2.4)), display / 12.92,
               lessThanEqual(display, vec3(0.04045)));
}

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    StrandFragment fragment = visibleStrand(picture).fragment;
    float shown = fragment.along;  // from strands/strand.glsl
    vec3 result;
    float alpha = 1.0;
    if (kShow == kShowTangents) {
        result = fromDisplay(directionColor(fragment.tangent));
    } else if (kShow == kShowNormals) {
        result = fromDisplay(directionColor(cylinderNormal(fragment)));
    } else if (kShow == kShowOverdraw || kShow == kShowDensity) {
        result = 1.0 / kFull;
        alpha = 0.0;  // leaves the target's alpha unchanged
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
