#version 460
// Averages the rendered samples of each pixel of the picture. Colours are display-referred and are
// averaged as they are, as a fixed-function resolve of these images does.
#extension GL_GOOGLE_include_directive : require
#include "post/rendered.glsl"
#include "shared/options.h"

layout(local_size_x = kResolveGroupSide, local_size_y = kResolveGroupSide) in;
// Samples per rendered pixel
layout(constant_id = kResolveSamplesConstant) const int kSamples = 1;
// Rendered pixels per picture pixel, along each side
layout(constant_id = kResolveFactorConstant) const int kFactor = 1;
layout(binding = 1, rgba8) uniform writeonly image2D picture;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(picture)))) return;
    vec4 sum = vec4(0.0);
    for (int y = 0; y < kFactor; ++y) {
        for (int x = 0; x < kFactor; ++x) {
            ivec2 from = pixel * kFactor + ivec2(x, y);
            for (int i = 0; i < kSamples; ++i) sum += renderedSample(from, i);
        }
    }
    imageStore(picture, pixel, sum / float(kFactor * kFactor * kSamples));
}
