#ifndef HAIRBENCH_LIGHT_STRUCTS_H
#define HAIRBENCH_LIGHT_STRUCTS_H

const uint kLightPoint = 0u;
const uint kLightDirectional = 1u;
const uint kLightSphere = 2u;

// A light of the picture: settings of the same names say what they are.
struct Light {
    vec3 position;  // m
    uint type;
    vec3 to_light;  // unit length; of directional ones
    float radius;  // m; of spheres
    vec3 color;  // working colours, with the strength
    float reference_distance;  // m
};

#endif
