// Makes a line of a strand into a quad that faces the camera, thesis 2.2: side = normalize(E x T),
// P -+ side w / 2. All stages that make corners share this code.
#ifndef HAIRBENCH_QUAD_CORNER_GLSL
#define HAIRBENCH_QUAD_CORNER_GLSL

#include "common/across.glsl"
#include "common/picture.glsl"
#include "shading/options.glsl"
#include "strands/line_end.glsl"
#include "strands/merged_word.glsl"
#include "strands/pixel_margin.glsl"

// True if fragments get the strand's width and their position across in metres. Only lengths are
// consistent on both triangles of a quad that narrows.
const bool kTellsWidth = kNeedsWidth || kMergedHairs != 0;

bool isAcrossInMetres(uint merged) {
    return kAnalyticCoverage != 0 || (kMergedHairs != 0 && mergedCount(merged) > 1.0);
}

// Distance and direction from an end of the line to the quad's edges.
struct QuadEnd {
    vec3 side;  // m
    float half_quad;  // m
};

struct QuadCorner {
    vec4 clip;
    vec4 position_and_across;  // m; across: -1 at one edge, 1 at the other, or m from the middle
    vec4 tangent_and_along;
    float half_width;  // m, of the strand without the gaps between merged hairs
    uint merged;
};

QuadEnd quadEnd(PictureParameters picture, LineEnd end) {
    QuadEnd quad;
    quad.half_quad = 0.5 * end.width;
    if (kMergedHairs != 0) quad.half_quad *= mergedSpread(end.merged);
    if (kAnalyticCoverage != 0) quad.half_quad += pixelMargin(picture, end.position);
    quad.side = sideOfLength(picture.eye - end.position, end.tangent, quad.half_quad);
    return quad;
}

// across: -1 or 1.
QuadCorner quadCorner(PictureParameters picture, LineEnd end, QuadEnd quad, float across) {
    precise vec3 place = end.position + across * quad.side;
    QuadCorner corner;
    corner.clip = picture.view_projection * vec4(place, 1.0);
    corner.position_and_across =
        vec4(place, isAcrossInMetres(end.merged) ? across * quad.half_quad : across);
    corner.tangent_and_along = vec4(end.tangent, end.along);
    corner.half_width = 0.5 * end.width;
    corner.merged = end.merged;
    return corner;
}

#endif
