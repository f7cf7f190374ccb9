#version 460
// Draws two triangles over the part of the picture that hair touches.
#extension GL_GOOGLE_include_directive : require
#include "strands/software/software.glsl"

void main() {
    uvec2 low;
    uvec2 high;
    hairBounds(low, high);
    uint corner = uint(gl_VertexIndex) % 3u + uint(gl_VertexIndex) / 3u;  // 0 1 2, 1 2 3
    high = max(high, low);  // empty if there is no hair
    float x = float((corner & 1u) == 0u ? low.x : high.x);
    float y = float((corner & 2u) == 0u ? low.y : high.y);
    gl_Position = vec4(2.0 * vec2(x, y) / vec2(push.width, push.height) - 1.0, 0.0, 1.0);
}
