#version 460
// A triangle mesh, such as the head, pulled from its buffers by index.
#extension GL_GOOGLE_include_directive : require
#include "common/picture.glsl"

layout(buffer_reference, scalar) readonly buffer Vectors { vec3 values[]; };
layout(push_constant, scalar) uniform Push { MeshPush push; };

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;

void main() {
    position = Vectors(push.positions).values[gl_VertexIndex];
    normal = Vectors(push.normals).values[gl_VertexIndex];
    gl_Position = PictureReference(push.picture).parameters.view_projection * vec4(position, 1.0);
}
