// The light that a point of a strand sends to the eye, by the model that is asked for.
#ifndef HAIRBENCH_STRAND_SHADING_GLSL
#define HAIRBENCH_STRAND_SHADING_GLSL

#include "common/picture.glsl"
#include "shading/lights.glsl"
#include "shading/options.glsl"
#include "shading/phong.glsl"
#include "shading/shadows.glsl"

// A point of a strand's quad.
struct StrandFragment {
    vec3 position;  // m
    vec3 tangent;  // unit length, towards the tip
    vec3 to_eye;  // unit length
    float across;  // -1 at one edge, 1 at the other
    float along;  // 0 at the root, 1 at the tip
};

// The normal turns with the place across the strand, as that of the half of a cylinder that faces
// the camera (the published program takes the side vector, the same for the whole width).
vec3 cylinderNormal(StrandFragment fragment) {
    vec3 side = normalize(cross(fragment.to_eye, fragment.tangent));
    vec3 facing = cross(fragment.tangent, side);
    float x = clamp(fragment.across, -1.0, 1.0);
    return x * side + sqrt(1.0 - x * x) * facing;
}

// Working colours. `hair_color` is the picture's, or with a texture's factor.
vec3 shadeStrand(PictureParameters picture, StrandFragment fragment, vec3 hair_color) {
    vec3 normal = cylinderNormal(fragment);
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < kLightCount; ++i) {
        LightSample light = lightAt(pictureLight(picture, i), fragment.position);
        PhongLight reflected = phong(normal, light.to_light, fragment.to_eye, picture.exponent);
        vec3 body = hair_color * (picture.ambient + picture.diffuse * reflected.diffuse);
        sum += (body + picture.specular * reflected.specular) * light.color;
    }
    return sum;
}

#endif
