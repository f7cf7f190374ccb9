#version 460
// Initialises the samples within the hair's bounds with the scene's depth. One work group per row
// of pixels.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "common/depth.glsl"
#include "strands/software/software.glsl"

layout(local_size_x_id = kGroupConstant) in;

#ifdef HAIRBENCH_MULTISAMPLE
layout(binding = 0) uniform texture2DMS scene_depth;
#else
layout(binding = 0) uniform texture2D scene_depth;
#endif

// With one sample per pixel, `index` is the mip level 0; with several it is the sample.
float sceneDepth(uvec2 pixel, uint index) {
    return texelFetch(scene_depth, ivec2(pixel), int(index)).r;
}

void main() {
    uvec2 low;
    uvec2 high;
    hairBounds(low, high);
    uvec2 pixel = uvec2(low.x, gl_WorkGroupID.x);
    if (pixel.y < low.y || pixel.y >= high.y) return;
    for (pixel.x += gl_LocalInvocationID.x; pixel.x < high.x; pixel.x += gl_WorkGroupSize.x) {
        for (uint i = 0u; i < kSamples; ++i) {
            float depth = sceneDepth(pixel, i);
            storePair(push.visibility, sampleIndex(pixel, i), uvec2(kNoPiece, nearness(depth)));
        }
    }
}
