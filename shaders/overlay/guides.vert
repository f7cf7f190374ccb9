#version 460
// The simulated guides as a line list: [guide][segment][end].
#extension GL_GOOGLE_include_directive : require
#include "common/picture.glsl"

layout(push_constant, scalar) uniform Push { OverlayPush push; };

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    uint segments = picture.vertices_per_guide - 1;
    uint line = uint(gl_VertexIndex) / 2u;
    uint vertex = line % segments + uint(gl_VertexIndex) % 2u;
    uint index = line / segments * picture.vertices_per_guide + vertex;
    gl_Position = picture.view_projection * vec4(GuidePoints(picture.guides).points[index].xyz, 1.0);
}
