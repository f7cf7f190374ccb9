#version 460
// strands/strand.geom as a watched stage: strands/watch.glsl.
#extension GL_GOOGLE_include_directive : require
#include "strands/geometry_lines.glsl"
#include "strands/quad.glsl"
#include "strands/watch.glsl"

void main() {
    if (position_and_width[0].w < 0.0) return;
    PictureParameters picture = PictureReference(push.picture).parameters;
    uint outputs = 0;
    for (int i = 0; i < 2; ++i) {
        LineEnd end = lineEnd(i);
        QuadEnd quad = quadEnd(picture, end);
        for (float across = -1.0; across <= 1.0; across += 2.0) {
            makeCorner(picture, end, quad, across);
            outputs += bitSum(gl_Position) + bitSum(position_and_across) +
                    bitSum(tangent_and_along_out);
            if (kAnalyticCoverage != 0) outputs += floatBitsToUint(half_width);
            EmitVertex();
        }
    }
    countInvocation(outputs);
}
