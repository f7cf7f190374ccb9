// A line of a strand -> a quad that faces the camera, thesis 2.2: side = normalize(E x T), P -+ side w / 2.
// Its outputs are those of the last stage before the rasteriser, geometry or vertex.
#ifndef HAIRBENCH_QUAD_GLSL
#define HAIRBENCH_QUAD_GLSL

#include "common/across.glsl"
#include "common/picture.glsl"
#include "shading/options.glsl"
#include "strands/line_end.glsl"
#include "strands/pixel_margin.glsl"

layout(location = 0) out vec4 position_and_across;  // m; across: -1 at one edge, 1 at the other, or
                                                    // with analytic coverage m from the middle
layout(location = 1) out vec4 tangent_and_along_out;
layout(location = 2) out float half_width;  // m; with analytic coverage
// What one back end or pass covers the others cover too, sample by sample.
invariant gl_Position;

// How far the quad's edges are from an end of the line, and where to.
struct QuadEnd {
    vec3 side;  // m
    float half_quad;  // m
};

QuadEnd quadEnd(PictureParameters picture, LineEnd end) {
    QuadEnd quad;
    quad.half_quad = 0.5 * end.width;
    if (kAnalyticCoverage != 0) quad.half_quad += pixelMargin(picture, end.position);
    quad.side = sideOfLength(picture.eye - end.position, end.tangent, quad.half_quad);
    return quad;
}

// The outputs of a corner of the quad; across: -1 or 1.
void makeCorner(PictureParameters picture, LineEnd end, QuadEnd quad, float across) {
    precise vec3 corner = end.position + across * quad.side;
    gl_Position = picture.view_projection * vec4(corner, 1.0);
    position_and_across =
        vec4(corner, kAnalyticCoverage != 0 ? across * quad.half_quad : across);
    tangent_and_along_out = vec4(end.tangent, end.along);
    if (kAnalyticCoverage != 0) half_width = 0.5 * end.width;
}

#endif
