#version 460
// Draws a triangle mesh that moves with the head or stands still. It fetches vertices from buffers
// by index.
#extension GL_GOOGLE_include_directive : require
#include "common/picture.glsl"
#include "scene/options.glsl"
#include "shared/mesh_structs.h"

layout(buffer_reference, scalar) readonly buffer Vectors { vec3 values[]; };
layout(buffer_reference, scalar) readonly buffer Coordinates { vec2 values[]; };
#ifdef HAIRBENCH_SCATTERING
layout(buffer_reference, scalar) readonly buffer Curvatures { float values[]; };
#endif
layout(push_constant, scalar) uniform Push { MeshPush push; };

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec2 coordinates;
#ifdef HAIRBENCH_INDIRECT
layout(location = 3) out vec3 indirect;
#endif
#ifdef HAIRBENCH_SCATTERING
layout(location = 4) out float curvature;
#endif
invariant gl_Position;  // the same in every pass

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    position = Vectors(push.positions).values[gl_VertexIndex];
    normal = Vectors(push.normals).values[gl_VertexIndex];
    if (push.is_moving == 1u) {
        position = (picture.head * vec4(position, 1.0)).xyz;
        normal = mat3(picture.head) * normal;
    }
    coordinates = vec2(0.0);
    if (kTextured) coordinates = Coordinates(push.texture_coordinates).values[gl_VertexIndex];
#ifdef HAIRBENCH_INDIRECT
    indirect = Vectors(push.indirect).values[gl_VertexIndex];
#endif
#ifdef HAIRBENCH_SCATTERING
    curvature = 0.0;
    if (push.curvatures != Address(0))
        curvature = Curvatures(push.curvatures).values[gl_VertexIndex];
#endif
    gl_Position = picture.view_projection * vec4(position, 1.0);
}
