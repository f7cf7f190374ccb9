// A line of a strand -> a quad that faces the light, and the part of it that the strand covers: a
// strand thinner than a texel of the map is as wide as one and as much less opaque, so that what it
// covers of the map has the right mean, however thin it is. What its corners are, whichever stage
// makes them.
#ifndef HAIRBENCH_SHADOW_QUAD_CORNER_GLSL
#define HAIRBENCH_SHADOW_QUAD_CORNER_GLSL

#include "common/across.glsl"
#include "common/picture.glsl"
#include "strands/line_end.glsl"
#include "strands/merged_word.glsl"

struct QuadEnd {
    vec3 side;  // m
    float coverage;
};

struct QuadCorner {
    vec4 clip;
    float coverage;
};

QuadEnd quadEnd(PictureParameters picture, LineEnd end) {
    // Along the view, not to the eye: a texel spans as much at all points of one depth.
    float depth = (picture.view_projection * vec4(end.position, 1.0)).w;
    float texel = picture.pixel_near + picture.pixel_slope * max(depth, 0.0);
    // Merged hairs lie apart: what they cover is spread over their strip.
    float width = max(end.width * mergedSpread(end.merged), texel);
    QuadEnd quad;
    quad.side = sideOfLength(picture.eye - end.position, end.tangent, 0.5 * width);
    quad.coverage = picture.opacity * max(end.width, 0.0) / max(width, 1e-30);
    return quad;
}

// across: -1 or 1.
QuadCorner quadCorner(PictureParameters picture, LineEnd end, QuadEnd quad, float across) {
    return QuadCorner(
        picture.view_projection * vec4(end.position + across * quad.side, 1.0), quad.coverage);
}

#endif
