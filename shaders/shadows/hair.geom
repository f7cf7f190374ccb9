#version 460
// A line of a strand -> a quad that faces the light, and the part of it that the strand covers: a
// strand thinner than a texel of the map is as wide as one and as much less opaque, so that what it
// covers of the map has the right mean, however thin it is.
#extension GL_GOOGLE_include_directive : require
#include "common/across.glsl"
#include "common/picture.glsl"

layout(lines) in;
layout(triangle_strip, max_vertices = 4) out;
layout(push_constant, scalar) uniform Push { StrandPush push; };

layout(location = 0) in vec4 position_and_width[];
layout(location = 1) in vec4 tangent_and_along[];
layout(location = 0) out float coverage;
invariant gl_Position;  // the same in the pass of depths and in that of opacity

void main() {
    vec2 widths = vec2(position_and_width[0].w, position_and_width[1].w);
    if (max(widths.x, widths.y) <= 0.0) return;
    PictureParameters picture = PictureReference(push.picture).parameters;
    for (int end = 0; end < 2; ++end) {
        vec3 position = position_and_width[end].xyz;
        // Along the view, not to the eye: a texel spans as much at all points of one depth.
        float depth = (picture.view_projection * vec4(position, 1.0)).w;
        float texel = picture.pixel_near + picture.pixel_slope * max(depth, 0.0);
        float width = max(widths[end], texel);
        vec3 side =
            sideOfLength(picture.eye - position, tangent_and_along[end].xyz, 0.5 * width);
        for (float across = -1.0; across <= 1.0; across += 2.0) {
            gl_Position = picture.view_projection * vec4(position + across * side, 1.0);
            coverage = picture.opacity * max(widths[end], 0.0) / max(width, 1e-30);
            EmitVertex();
        }
    }
}
