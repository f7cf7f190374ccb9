// The samples of a pixel, and the margin of a quad beyond the strand's edges, so that it covers every
// pixel that the strand touches.
#ifndef HAIRBENCH_PIXEL_MARGIN_GLSL
#define HAIRBENCH_PIXEL_MARGIN_GLSL

#include "common/picture.glsl"
#include "shared/options.h"

layout(constant_id = kPixelSamplesConstant) const uint kSamples = 1;  // of a rendered pixel

// A pixel with a corner on the edge has its centre half a diagonal away, and one of its samples may
// be as far again. The value is a little more than half, for rounding.
const float kHalfDiagonal = 0.7075;  // px

// The margin at a position, m.
float pixelMargin(PictureParameters picture, vec3 position) {
    float depth = max((picture.view_projection * vec4(position, 1.0)).w, 0.0);
    float pixel = picture.pixel_near + picture.pixel_slope * depth;
    return (kSamples > 1u ? 2.0 : 1.0) * kHalfDiagonal * pixel;
}

#endif
