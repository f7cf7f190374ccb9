#version 460
// Makes a line of a strand into its quad in a light's map.
#extension GL_GOOGLE_include_directive : require
#include "shadows/quad.glsl"
#include "strands/geometry_lines.glsl"

layout(push_constant, scalar) uniform Push { StrandPush push; };

void main() {
    if (max(position_and_width[0].w, position_and_width[1].w) <= 0.0) return;
    PictureParameters picture = PictureReference(push.picture).parameters;
    for (int i = 0; i < 2; ++i) {
        LineEnd end = lineEnd(i);
        QuadEnd quad = quadEnd(picture, end);
        for (float across = -1.0; across <= 1.0; across += 2.0) {
            makeCorner(picture, end, quad, across);
            EmitVertex();
        }
    }
}
