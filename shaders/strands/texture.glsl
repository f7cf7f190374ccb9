// A texture on strands, thesis 2.2.
#ifndef HAIRBENCH_STRAND_TEXTURE_GLSL
#define HAIRBENCH_STRAND_TEXTURE_GLSL

#include "shading/options.glsl"

layout(binding = 0) uniform sampler2D strand_texture;

// Factors on colour and opacity. across: -1 to 1; along: 0 at the root, 1 at the tip.
vec4 strandTexel(float across, float along) {
    if (kStrandTexture == 0u) return vec4(1.0);
    return texture(strand_texture, vec2(0.5 + 0.5 * across, along));
}

#endif
