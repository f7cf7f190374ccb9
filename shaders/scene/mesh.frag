#version 460
// A matt surface under the picture's light, with the same ambient part as the hair.
#extension GL_GOOGLE_include_directive : require
#include "common/picture.glsl"
#include "shading/lights.glsl"
#include "shading/phong.glsl"

layout(push_constant, scalar) uniform Push { MeshPush push; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec4 color;

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    vec3 to_eye = normalize(picture.eye - position);
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < picture.light_count; ++i) {
        LightSample light = lightAt(pictureLight(picture, i), position);
        PhongLight reflected = phong(normalize(normal), light.to_light, to_eye, 1.0);
        vec3 body = push.base_color * (picture.ambient + picture.diffuse * reflected.diffuse);
        sum += body * light.color;
    }
    color = vec4(sum, 1.0);
}
