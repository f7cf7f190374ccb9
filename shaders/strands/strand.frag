#version 460
// A strand's quad, opaque; where its texture is less than half so, and between the hairs that it
// stands for, there is a hole.
#extension GL_GOOGLE_include_directive : require
#include "strands/fragment.glsl"

layout(location = 0) out vec4 color;

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    SeenStrand seen = seenStrand(picture);
    if (kMergedHairs != 0 && seen.coverage == 0.0) discard;
    if (kStrandTexture != 0 && seen.factors.a < 0.5) discard;
    color = vec4(strandColor(picture, seen), 1.0);
}
