#version 460
// Outputs a sample's colour and depth if it shows a strand.
#extension GL_GOOGLE_include_directive : require
#ifdef HAIRBENCH_TEXELS
#define kVisibilityTexels 0
#endif
#include "common/depth.glsl"
#include "shading/options.glsl"
#include "strands/software/visibility.glsl"

layout(location = 0) out vec4 color;

void main() {
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    // A helper invocation may lie outside the picture, past the end of the samples.
    if (pixel.x >= push.width || pixel.y >= push.height) return;
    uint index = sampleIndex(pixel, push.choice);
    uvec2 visible = fetchVisibility(index);
    if (visible.x == kNoPiece) discard;
    gl_FragDepth = depthOf(visible.y);
    gl_SampleMask[0] = 1 << push.choice;  // choice is 0 with one sample per pixel
    if (kLinearLight == 1u) {
        uvec2 light = loadPair(push.colors, index);
        color = vec4(unpackHalf2x16(light.x), unpackHalf2x16(light.y).x, 1.0);
    } else {
        color = vec4(unpackUnorm4x8(visible.x).rgb, 1.0);
    }
}
