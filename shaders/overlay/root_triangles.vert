#version 460
// Draws the edges of the root triangles as quads: [triangle][edge][corner].
#extension GL_GOOGLE_include_directive : require
#include "overlay/overlay.glsl"

vec3 corner(PictureParameters picture, uint triangle, uint index) {
    uint guide = RootTriangles(picture.root_triangles).guides[3u * triangle + index % 3u];
    return GuidePoints(picture.guides).points[guide * picture.vertices_per_guide].xyz;
}

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    uint line = lineIndex();
    vec3 from = corner(picture, line / 3u, line % 3u);
    vec3 to = corner(picture, line / 3u, line % 3u + 1u);
    emitCorner(picture, from, to, kOverlayWidth, kAnyPixels);
}
