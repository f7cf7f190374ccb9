#version 460
// Draws the simulated guides as quads: [guide][segment][corner].
#extension GL_GOOGLE_include_directive : require
#include "overlay/overlay.glsl"

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    uint segments = picture.vertices_per_guide - 1;
    uint line = lineIndex();
    uint first = line / segments * picture.vertices_per_guide + line % segments;
    GuidePoints guides = GuidePoints(picture.guides);
    vec3 from = guides.points[first].xyz;
    vec3 to = guides.points[first + 1].xyz;
    emitCorner(picture, from, to, kOverlayWidth, kGuidePixels);
}
