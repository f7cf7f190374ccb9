#version 460
// The edges of the root triangles as a line list: [triangle][edge][end].
#extension GL_GOOGLE_include_directive : require
#include "common/picture.glsl"

layout(push_constant, scalar) uniform Push { OverlayPush push; };

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    uint line = uint(gl_VertexIndex) / 2u;
    uint corner = (line + uint(gl_VertexIndex) % 2u) % 3u;
    uint guide = RootTriangles(picture.root_triangles).guides[3u * (line / 3u) + corner];
    vec3 root = GuidePoints(picture.guides).points[guide * picture.vertices_per_guide].xyz;
    gl_Position = picture.view_projection * vec4(root, 1.0);
}
