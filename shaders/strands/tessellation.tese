#version 460
// Evaluates a vertex of a strand for the geometry stage. HAIRBENCH_WATCHED is for a watched
// stage (strands/watch.glsl).
#extension GL_GOOGLE_include_directive : require
#include "strands/evaluation.glsl"
#include "strands/watch.glsl"

layout(location = 0) out vec4 position_and_width;
layout(location = 1) out vec4 tangent_and_along;
layout(location = 2) out uint merged_hairs;  // set if kTellsHairs

void main() {
    StrandPoint point = evaluatedPoint(PictureReference(push.picture).parameters);
    position_and_width = vec4(point.position, point.width);
    tangent_and_along = vec4(point.tangent, point.along);
    if (kTellsHairs) merged_hairs = point.merged;
#ifdef HAIRBENCH_WATCHED
    countInvocation(bitSum(position_and_width) + bitSum(tangent_and_along));
#endif
}
