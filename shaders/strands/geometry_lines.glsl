// The geometry stage that makes quads: its inputs for a line and its number of corners.
#ifndef HAIRBENCH_GEOMETRY_LINES_GLSL
#define HAIRBENCH_GEOMETRY_LINES_GLSL

#include "strands/line_end.glsl"

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

#endif
