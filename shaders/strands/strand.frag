#version 460
// Draws a strand's quad, opaque. It discards fragments if the texture's opacity is below half, and
// fragments between the hairs that the strand stands for.
#extension GL_GOOGLE_include_directive : require
#include "strands/fragment.glsl"

layout(location = 0) out vec4 color;

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    VisibleStrand visible = visibleStrand(picture);
    if (kMergedHairs != 0 && visible.coverage == 0.0) discard;
    if (kStrandTexture != 0 && visible.factors.a < 0.5) discard;
    color = vec4(strandColor(picture, visible), 1.0);
}
