#version 460
// The tessellation back end's first stage: names the patch. A draw numbers patches by vertex, by instance,
// or by both, in the order [triangle][part][segment].
#extension GL_GOOGLE_include_directive : require
#include "common/picture.glsl"

layout(push_constant, scalar) uniform Push { StrandPush push; };

layout(location = 0) out uint patch_index;

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    uint segments = picture.vertices_per_guide - 1;
    patch_index = uint(gl_InstanceIndex) * segments + uint(gl_VertexIndex);
}
