#version 460
// Draws strands as lines one pixel wide, with the part of the pixels that they cover. Thesis 2.2
// shows the faults of this method.
#extension GL_GOOGLE_include_directive : require
#include "common/depth.glsl"
#include "strands/line_list.glsl"

layout(push_constant, scalar) uniform Push { StrandPush push; };

// 1: the device draws lines as rectangles one pixel wide; 0: with one pixel per row or column.
layout(constant_id = kStrictLinesConstant) const uint kStrictLines = 0;

layout(location = 0) out vec4 position_and_across;  // m; w is 0, the middle
layout(location = 1) out vec4 tangent_and_along_out;
layout(location = 2) out float line_coverage;
layout(location = 3) flat out uint merged_hairs;  // for own colours; lines show no merged hairs
invariant gl_Position;

// Ratio of a line's length on the screen to its extent in rows or columns.
float slant(PictureParameters picture, vec3 tangent) {
    mat4 rows = transpose(picture.view_projection);
    vec4 moved = picture.view_projection * vec4(tangent, 0.0);
    vec2 run = moved.xy * gl_Position.w - gl_Position.xy * moved.w;
    run.x *= length(rows[1].xyz) / length(rows[0].xyz);  // pixels are square
    return length(run) / max(max(abs(run.x), abs(run.y)), 1e-30);
}

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    bool drawn;
    StrandPoint point = listedPoint(picture, uint(gl_VertexIndex), drawn);
    gl_Position = picture.view_projection * vec4(point.position, 1.0);
    float pixel = picture.pixel_near + picture.pixel_slope * max(gl_Position.w, 0.0);
    line_coverage = point.width / max(pixel, 1e-30);
    if (kStrictLines == 0) line_coverage *= slant(picture, point.tangent);
    line_coverage = min(line_coverage, 1.0);
    position_and_across = vec4(point.position, 0.0);
    tangent_and_along_out = vec4(point.tangent, point.along);
    merged_hairs = kOwnColors != 0 ? point.merged : 0u;
    if (!drawn) gl_Position = kClippedPosition;
}
