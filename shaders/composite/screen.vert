#version 460
// Draws one triangle that covers the whole target.

void main() {
    vec2 corner = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1);  // (0, 0), (1, 0), (0, 1)
    gl_Position = vec4(4.0 * corner - 1.0, 0.0, 1.0);
}
