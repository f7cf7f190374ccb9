// A picture on strands, thesis 2.2.
#ifndef HAIRBENCH_STRAND_TEXTURE_GLSL
#define HAIRBENCH_STRAND_TEXTURE_GLSL

#include "shading/options.glsl"

// Factors of colour and opacity. across: -1 to 1; along: 0 at the root, 1 at the tip.
vec4 strandTexel(float across, float along) { return vec4(1.0); }

#endif
