#version 460
// The first stage of the tessellation back end: passes on the patch's number.
#extension GL_GOOGLE_include_directive : require
#include "strands/patch_number.glsl"

layout(push_constant, scalar) uniform Push { StrandPush push; };

layout(location = 0) out uint patch_index;

void main() { patch_index = patchNumber(PictureReference(push.picture).parameters); }
