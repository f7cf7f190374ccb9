#version 460
// The wire frames of bodies as a line list: [line][end].
#extension GL_GOOGLE_include_directive : require
#include "overlay/overlay.glsl"

layout(buffer_reference, scalar) readonly buffer BodyLines { BodyLine lines[]; };

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    BodyLine line = BodyLines(push.lines).lines[gl_VertexIndex / 2];
    mat4 head = line.moves != 0u ? picture.head : mat4(1.0);
    vec3 from = (head * vec4(line.from, 1.0)).xyz;
    vec3 to = (head * vec4(line.to, 1.0)).xyz;
    emitLineEnd(picture, gl_VertexIndex % 2 == 0 ? from : to, to - from, kBodyWidth);
}
