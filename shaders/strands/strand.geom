#version 460
// A line of a strand -> its quad.
#extension GL_GOOGLE_include_directive : require
#include "strands/quad.glsl"

layout(push_constant, scalar) uniform Push { StrandPush push; };

void main() {
    if (!isDrawn()) return;
    PictureParameters picture = PictureReference(push.picture).parameters;
    for (int end = 0; end < 2; ++end) {
        QuadEnd quad = quadEnd(picture, end);
        for (float across = -1.0; across <= 1.0; across += 2.0) {
            makeCorner(picture, end, quad, across);
            EmitVertex();
        }
    }
}
