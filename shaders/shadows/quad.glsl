// Outputs of the corners of strands' quads in a light's map, from the last stage before the
// rasteriser (geometry or vertex).
#ifndef HAIRBENCH_SHADOW_QUAD_GLSL
#define HAIRBENCH_SHADOW_QUAD_GLSL

#include "shadows/quad_corner.glsl"

layout(location = 0) out float coverage;
invariant gl_Position;  // the same in the depth pass and the opacity pass

// Sets the outputs for a corner of the quad; across: -1 or 1.
void makeCorner(PictureParameters picture, LineEnd end, QuadEnd quad, float across) {
    QuadCorner corner = quadCorner(picture, end, quad, across);
    gl_Position = corner.clip;
    coverage = corner.coverage;
}

#endif
