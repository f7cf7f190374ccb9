#version 460
// Averages rendered linear light over each pixel of the picture and converts it for the display.
#extension GL_GOOGLE_include_directive : require
#include "post/rendered.glsl"
#include "common/display_color.glsl"
#include "post/tone_map_aces.glsl"
#include "post/tone_map_agx.glsl"
#include "shared/options.h"

layout(local_size_x = kResolveGroupSide, local_size_y = kResolveGroupSide) in;
// Samples per rendered pixel
layout(constant_id = kResolveSamplesConstant) const int kSamples = 1;
// Rendered pixels per picture pixel, along each side
layout(constant_id = kResolveFactorConstant) const int kFactor = 1;
layout(constant_id = kResolveToneMapConstant) const uint kToneMap = kToneMapSrgb;
// Factor on the light
layout(constant_id = kResolveExposureConstant) const float kExposure = 1.0;
layout(binding = 1, rgba32f) uniform writeonly image2D radiance;
layout(binding = 2, rgba8) uniform writeonly image2D picture;

const float kMostHalf = 65504.0;  // largest half-precision float

// Keeps one bad sample from spoiling its pixel. Negative values and NaN (for which no comparison
// holds) become black; infinity becomes the largest half float.
vec3 soundLight(vec3 light) {
    return min(mix(vec3(0.0), light, greaterThan(light, vec3(0.0))), vec3(kMostHalf));
}

vec3 meanLight(ivec2 pixel) {
    vec3 sum = vec3(0.0);
    for (int y = 0; y < kFactor; ++y) {
        for (int x = 0; x < kFactor; ++x) {
            for (int i = 0; i < kSamples; ++i) {
                sum += soundLight(renderedSample(pixel * kFactor + ivec2(x, y), i).rgb);
            }
        }
    }
    return sum / float(kFactor * kFactor * kSamples);
}

vec3 toneMapped(vec3 light) {
    if (kToneMap == kToneMapAces) return toneMapAces(light);
    if (kToneMap == kToneMapAgx) return toneMapAgx(light);
    return light;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(picture)))) return;
    vec3 light = meanLight(pixel);
    imageStore(radiance, pixel, vec4(light, 1.0));
    vec3 shown = clamp(toneMapped(kExposure * light), 0.0, 1.0);
    imageStore(picture, pixel, vec4(toDisplay(shown), 1.0));
}
