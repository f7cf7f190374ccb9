// The patch for a vertex of the tessellation back end. A draw numbers patches by vertex, by
// instance, or by both, in the order [triangle][part][segment].
#ifndef HAIRBENCH_PATCH_NUMBER_GLSL
#define HAIRBENCH_PATCH_NUMBER_GLSL

#include "common/picture.glsl"

uint patchNumber(PictureParameters picture) {
    uint segments = picture.vertices_per_guide - 1;
    return uint(gl_InstanceIndex) * segments + uint(gl_VertexIndex);
}

#endif
