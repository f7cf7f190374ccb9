#version 460
// A triangle mesh that moves with the head, pulled from its buffers by index.
#extension GL_GOOGLE_include_directive : require
#include "common/picture.glsl"

layout(buffer_reference, scalar) readonly buffer Vectors { vec3 values[]; };
layout(push_constant, scalar) uniform Push { MeshPush push; };

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    position = (picture.head * vec4(Vectors(push.positions).values[gl_VertexIndex], 1.0)).xyz;
    normal = mat3(picture.head) * Vectors(push.normals).values[gl_VertexIndex];
    gl_Position = picture.view_projection * vec4(position, 1.0);
}
