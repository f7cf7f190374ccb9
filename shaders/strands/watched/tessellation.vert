#version 460
// strands/tessellation.vert as a watched stage: strands/watch.glsl.
#extension GL_GOOGLE_include_directive : require
#include "strands/patch_number.glsl"
#include "strands/watch.glsl"

layout(location = 0) out uint patch_index;

void main() {
    patch_index = patchNumber(PictureReference(push.picture).parameters);
    gl_PointSize = 1.0;  // if it is the last stage, vertices are points
    countInvocation(patch_index);
}
