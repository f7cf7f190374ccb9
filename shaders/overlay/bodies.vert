#version 460
// Draws the wire frames of bodies as quads: [line][corner].
#extension GL_GOOGLE_include_directive : require
#include "overlay/overlay.glsl"

layout(buffer_reference, scalar) readonly buffer BodyLines { BodyLine lines[]; };

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    BodyLine line = BodyLines(push.lines).lines[lineIndex()];
    mat4 head = line.moves != 0u ? picture.head : mat4(1.0);
    vec3 from = (head * vec4(line.from, 1.0)).xyz;
    vec3 to = (head * vec4(line.to, 1.0)).xyz;
    emitCorner(picture, from, to, kBodyWidth, kAnyPixels);
}
