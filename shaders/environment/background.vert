#version 460
// Draws one triangle over the whole picture at the far plane, with each pixel's view direction.
#extension GL_GOOGLE_include_directive : require
#include "common/depth.glsl"
#include "common/picture.glsl"

layout(push_constant, scalar) uniform Push { EnvironmentPush push; };

layout(location = 0) out vec3 direction;  // world space, not of unit length

void main() {
    vec2 place = 4.0 * vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) - 1.0;
    gl_Position = vec4(place, float(kFarDepth), 1.0);
    // A direction d is seen at (r0 d / r3 d, r1 d / r3 d), where r are the matrix's rows. The
    // translation drops out, because the eye is at 0 in all three.
    mat4 rows = transpose(PictureReference(push.picture).parameters.view_projection);
    direction = inverse(transpose(mat3(rows[0].xyz, rows[1].xyz, rows[3].xyz))) * vec3(place, 1.0);
}
