// Outputs of the corners of strands' quads, from the last stage before the rasteriser (geometry or
// vertex).
#ifndef HAIRBENCH_QUAD_GLSL
#define HAIRBENCH_QUAD_GLSL

#include "strands/quad_corner.glsl"

layout(location = 0) out vec4 position_and_across;
layout(location = 1) out vec4 tangent_and_along_out;
layout(location = 2) out float half_width;  // set if kTellsWidth
layout(location = 3) flat out uint merged_hairs_out;  // set if kTellsHairs
// All back ends and passes cover the same samples.
invariant gl_Position;

// Sets the outputs for a corner of the quad; across: -1 or 1.
void makeCorner(PictureParameters picture, LineEnd end, QuadEnd quad, float across) {
    QuadCorner corner = quadCorner(picture, end, quad, across);
    gl_Position = corner.clip;
    position_and_across = corner.position_and_across;
    tangent_and_along_out = corner.tangent_and_along;
    if (kTellsWidth) half_width = corner.half_width;
    if (kTellsHairs) merged_hairs_out = corner.merged;
}

#endif
