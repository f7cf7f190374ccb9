// Light from the environment.
#ifndef HAIRBENCH_ENVIRONMENT_GLSL
#define HAIRBENCH_ENVIRONMENT_GLSL

#include "common/display_color.glsl"
#include "common/picture.glsl"
#include "environment/parameters.glsl"
#include "shading/options.glsl"

// Irradiance / pi on a surface with this unit normal, in working colours. A white matt surface
// would show it. Ramamoorthi and Hanrahan 2001, An Efficient Representation for Irradiance
// Environment Maps, eqs. 3 and 10.
vec3 environmentLight(PictureParameters picture, vec3 normal) {
    vec3 c[9] = EnvironmentReference(picture.environment).parameters.irradiance;
    vec3 n = normal;
    vec3 light = 0.282095 * c[0];
    light += 0.488603 * (n.y * c[1] + n.z * c[2] + n.x * c[3]);
    light += 1.092548 * (n.x * n.y * c[4] + n.y * n.z * c[5] + n.x * n.z * c[7]);
    light += 0.315392 * (3.0 * n.z * n.z - 1.0) * c[6];
    light += 0.546274 * (n.x * n.x - n.y * n.y) * c[8];
    light = max(light, vec3(0.0));  // nine terms of a small bright light fall below zero in places
    if (kLinearLight == 1u) return light;
    return toDisplay(min(light, vec3(1.0)));
}

#endif
