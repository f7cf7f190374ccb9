#ifndef HAIRBENCH_LIGHT_STRUCTS_H
#define HAIRBENCH_LIGHT_STRUCTS_H

const uint kLightPoint = 0u;
const uint kLightDirectional = 1u;
const uint kLightSphere = 2u;

// Kinds of lights beside the thesis's, points of the same strength everywhere: bits of kLightKinds
// in shading/options.glsl.
const uint kSomeDirectional = 1u;
const uint kSomeSpheres = 2u;  // or directional ones that are no points
const uint kSomeWeaken = 4u;  // with distance
const uint kAllLightKinds = 7u;

// A light of the picture: settings of the same names say what they are.
struct Light {
    vec3 position;  // m
    uint type;
    vec3 to_light;  // unit length; of directional ones
    float radius;  // m, of spheres; rad, of directional ones; else 0
    vec3 color;  // working colours, with the strength
    float reference_distance;  // m; 0 of directional ones
};

#endif
