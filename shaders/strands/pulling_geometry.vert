#version 460
// Evaluates strands without tessellation, for the geometry stage of the tessellation back end.
#extension GL_GOOGLE_include_directive : require
#include "strands/line_list.glsl"

layout(push_constant, scalar) uniform Push { StrandPush push; };

layout(location = 0) out vec4 position_and_width;  // a negative width drops the line
layout(location = 1) out vec4 tangent_and_along;
layout(location = 2) out uint merged_hairs;  // set if kTellsHairs

void main() {
    bool drawn;
    StrandPoint point = listedPoint(
        PictureReference(push.picture).parameters, uint(gl_VertexIndex), drawn);
    position_and_width = vec4(point.position, drawn ? point.width : -1.0);
    tangent_and_along = vec4(point.tangent, point.along);
    if (kTellsHairs) merged_hairs = point.merged;
}
