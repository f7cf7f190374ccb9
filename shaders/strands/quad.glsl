// A line of a strand -> a quad that faces the camera, thesis 2.2: side = normalize(E x T), P -+ side w / 2.
#ifndef HAIRBENCH_QUAD_GLSL
#define HAIRBENCH_QUAD_GLSL

#include "common/across.glsl"
#include "common/picture.glsl"
#include "shading/options.glsl"
#include "strands/pixel_margin.glsl"

layout(lines) in;
layout(triangle_strip, max_vertices = 4) out;

layout(location = 0) in vec4 position_and_width[];
layout(location = 1) in vec4 tangent_and_along[];
layout(location = 0) out vec4 position_and_across;  // m; across: -1 at one edge, 1 at the other, or
                                                    // with analytic coverage m from the middle
layout(location = 1) out vec4 tangent_and_along_out;
layout(location = 2) out float half_width;  // m; with analytic coverage
// What one back end or pass covers the others cover too, sample by sample.
invariant gl_Position;

// Whether the line is one of a strand.
bool isDrawn() { return position_and_width[0].w >= 0.0; }

// How far the quad's edges are from an end of the line, and where to.
struct QuadEnd {
    vec3 side;  // m
    float half_quad;  // m
};

QuadEnd quadEnd(PictureParameters picture, int end) {
    vec3 position = position_and_width[end].xyz;
    QuadEnd quad;
    quad.half_quad = 0.5 * position_and_width[end].w;
    if (kAnalyticCoverage != 0) quad.half_quad += pixelMargin(picture, position);
    quad.side =
        sideOfLength(picture.eye - position, tangent_and_along[end].xyz, quad.half_quad);
    return quad;
}

// The outputs of a corner of the quad; across: -1 or 1.
void makeCorner(PictureParameters picture, int end, QuadEnd quad, float across) {
    precise vec3 corner = position_and_width[end].xyz + across * quad.side;
    gl_Position = picture.view_projection * vec4(corner, 1.0);
    position_and_across =
        vec4(corner, kAnalyticCoverage != 0 ? across * quad.half_quad : across);
    tangent_and_along_out = tangent_and_along[end];
    if (kAnalyticCoverage != 0) half_width = 0.5 * position_and_width[end].w;
}

#endif
