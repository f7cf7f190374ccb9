#version 460
// Makes a line of a strand into its quad. HAIRBENCH_SHADOW is for a light's map, HAIRBENCH_WATCHED
// for a watched stage (strands/watch.glsl).
#extension GL_GOOGLE_include_directive : require
#include "strands/line_end.glsl"
#ifdef HAIRBENCH_SHADOW
#include "shadows/quad.glsl"
#else
#include "strands/quad.glsl"
#endif
#include "strands/watch.glsl"

layout(lines) in;
layout(triangle_strip, max_vertices = 4) out;

layout(location = 0) in vec4 position_and_width[];  // a negative width drops the line
layout(location = 1) in vec4 tangent_and_along[];
layout(location = 2) in uint merged_hairs[];  // set if kTellsHairs

LineEnd lineEnd(int end) {
    vec4 position = position_and_width[end];
    vec4 tangent = tangent_and_along[end];
    return LineEnd(position.xyz, tangent.xyz, position.w, tangent.w, merged_hairs[end]);
}

void main() {
#ifdef HAIRBENCH_SHADOW
    if (max(position_and_width[0].w, position_and_width[1].w) <= 0.0) return;
#else
    if (position_and_width[0].w < 0.0) return;
#endif
    PictureParameters picture = PictureReference(push.picture).parameters;
#ifdef HAIRBENCH_WATCHED
    uint outputs = 0;
#endif
    for (int i = 0; i < 2; ++i) {
        LineEnd end = lineEnd(i);
        QuadEnd quad = quadEnd(picture, end);
        for (float across = -1.0; across <= 1.0; across += 2.0) {
            makeCorner(picture, end, quad, across);
#ifdef HAIRBENCH_WATCHED
            outputs += bitSum(gl_Position) + bitSum(position_and_across) +
                    bitSum(tangent_and_along_out);
            if (kAnalyticCoverage != 0) outputs += floatBitsToUint(half_width);
#endif
            EmitVertex();
        }
    }
#ifdef HAIRBENCH_WATCHED
    countInvocation(outputs);
#endif
}
