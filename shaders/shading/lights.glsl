// The lights of a picture.
#ifndef HAIRBENCH_LIGHTS_GLSL
#define HAIRBENCH_LIGHTS_GLSL

#include "common/picture.glsl"

layout(buffer_reference, scalar) readonly buffer Lights { Light lights[]; };

// A light as a point sees it.
struct LightSample {
    vec3 to_light;  // unit length
    vec3 color;  // what a white matt surface that faces it shows: irradiance / pi
    float angular_radius;  // rad
};

LightSample lightAt(Light light, vec3 position) {
    return LightSample(normalize(light.position - position), light.color, 0.0);
}

Light pictureLight(PictureParameters picture, uint index) {
    return Lights(picture.lights).lights[index];
}

#endif
