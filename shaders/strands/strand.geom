#version 460
// Makes a line of a strand into its quad.
#extension GL_GOOGLE_include_directive : require
#include "strands/geometry_lines.glsl"
#include "strands/quad.glsl"

layout(push_constant, scalar) uniform Push { StrandPush push; };

void main() {
    if (position_and_width[0].w < 0.0) return;
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
