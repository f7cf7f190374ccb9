#version 460
// Measures the arithmetic rate of the vertex stage. Its points lie outside the picture, but a
// compiler cannot know that.
#extension GL_GOOGLE_include_directive : require
#include "limits/arithmetic.glsl"

void main() {
    float result = chains(float(gl_VertexIndex & 63) / 64.0);
    gl_Position = vec4(2.0 + abs(result), 0.0, 0.0, 1.0);
    gl_PointSize = 1.0;
}
