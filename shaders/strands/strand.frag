#version 460
// A strand's quad shaded as the half of a cylinder that faces the camera.
#extension GL_GOOGLE_include_directive : require
#include "common/picture.glsl"
#include "shading/phong.glsl"

layout(push_constant, scalar) uniform Push { StrandPush push; };

layout(location = 0) in vec4 position_and_across;
layout(location = 1) in vec4 tangent_and_along;
layout(location = 0) out vec4 color;

// The cylinder's normal turns with the place across the strand (the published program takes the side
// vector, the same for the whole width).
vec3 cylinderNormal(vec3 tangent, vec3 to_eye, float across) {
    vec3 side = normalize(cross(to_eye, tangent));
    vec3 facing = cross(tangent, side);
    float x = clamp(across, -1.0, 1.0);
    return x * side + sqrt(1.0 - x * x) * facing;
}

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    vec3 position = position_and_across.xyz;
    vec3 to_eye = normalize(picture.eye - position);
    vec3 to_light = normalize(picture.light_position - position);
    vec3 normal = cylinderNormal(normalize(tangent_and_along.xyz), to_eye, position_and_across.w);
    PhongLight reflected = phong(normal, to_light, to_eye, picture.exponent);
    vec3 body = picture.hair_color * (picture.ambient + picture.diffuse * reflected.diffuse);
    color = vec4((body + picture.specular * reflected.specular) * picture.light_color, 1.0);
}
