// Makes a line of a strand into a quad that faces the light. A strand thinner than a texel of the
// map is drawn one texel wide and proportionally less opaque, so that its mean coverage is right at
// any width. All stages that make corners share this code.
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
    // Along the view, not to the eye: a texel has the same size at all points of one depth.
    float depth = (picture.view_projection * vec4(end.position, 1.0)).w;
    float texel = picture.pixel_near + picture.pixel_slope * max(depth, 0.0);
    // Merged hairs lie apart, so their coverage is spread over their strip.
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
