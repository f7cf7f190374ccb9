#version 460
// A line of a strand -> a quad that faces the camera, thesis 2.2: side = normalize(E x T), P -+ side w / 2.
#extension GL_GOOGLE_include_directive : require
#include "common/picture.glsl"
#include "shading/options.glsl"
#include "strands/pixel_margin.glsl"

layout(lines) in;
layout(triangle_strip, max_vertices = 4) out;
layout(push_constant, scalar) uniform Push { StrandPush push; };

layout(location = 0) in vec4 position_and_width[];
layout(location = 1) in vec4 tangent_and_along[];
layout(location = 0) out vec4 position_and_across;  // m; across: -1 at one edge, 1 at the other, or
                                                    // with analytic coverage m from the middle
layout(location = 1) out vec4 tangent_and_along_out;
layout(location = 2) out float half_width;  // m; with analytic coverage

void main() {
    if (position_and_width[0].w < 0.0) return;
    PictureParameters picture = PictureReference(push.picture).parameters;
    for (int end = 0; end < 2; ++end) {
        vec3 position = position_and_width[end].xyz;
        vec3 side = cross(picture.eye - position, tangent_and_along[end].xyz);
        float half_quad = 0.5 * position_and_width[end].w;
        if (kAnalyticCoverage != 0) half_quad += pixelMargin(picture, position);
        side *= half_quad * inversesqrt(max(dot(side, side), 1e-30));
        for (float across = -1.0; across <= 1.0; across += 2.0) {
            vec3 corner = position + across * side;
            gl_Position = picture.view_projection * vec4(corner, 1.0);
            position_and_across =
                vec4(corner, kAnalyticCoverage != 0 ? across * half_quad : across);
            tangent_and_along_out = tangent_and_along[end];
            if (kAnalyticCoverage != 0) half_width = 0.5 * position_and_width[end].w;
            EmitVertex();
        }
    }
}
