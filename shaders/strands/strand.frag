#version 460
// A strand's quad, opaque or with an alpha that covers samples.
#extension GL_GOOGLE_include_directive : require
#include "strands/fragment.glsl"

layout(location = 0) out vec4 color;

void main() { color = strandColor(PictureReference(push.picture).parameters); }
