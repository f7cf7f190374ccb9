#version 460
// The first stage of the tessellation back end: passes on the patch's number. HAIRBENCH_WATCHED is
// for a watched stage (strands/watch.glsl).
#extension GL_GOOGLE_include_directive : require
#include "common/picture.glsl"
#include "strands/watch.glsl"

layout(location = 0) out uint patch_index;

// A draw numbers patches by vertex, by instance, or by both, in the order [triangle][part][segment].
uint patchNumber(PictureParameters picture) {
    uint segments = picture.vertices_per_guide - 1;
    return uint(gl_InstanceIndex) * segments + uint(gl_VertexIndex);
}

void main() {
    patch_index = patchNumber(PictureReference(push.picture).parameters);
#ifdef HAIRBENCH_WATCHED
    gl_PointSize = 1.0;  // if it is the last stage, vertices are points
    countInvocation(patch_index);
#endif
}
