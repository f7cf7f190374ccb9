#ifndef HAIRBENCH_LIGHT_STRUCTS_H
#define HAIRBENCH_LIGHT_STRUCTS_H

const uint kLightPoint = 0u;
const uint kLightDirectional = 1u;
const uint kLightSphere = 2u;
const uint kLightRectangle = 3u;

// Kinds of lights other than the thesis's points of constant strength. They are bits of kLightKinds
// in shading/options.glsl.
const uint kSomeDirectional = 1u;
const uint kSomeSpheres = 2u;  // or directional lights with an angular radius
const uint kSomeAttenuate = 4u;  // fall off with distance
const uint kSomeRectangles = 8u;
const uint kSomeSampled = 16u;  // sampled by several shadow maps
const uint kAllLightKinds = 31u;

// A light of the picture. Settings of the same names document the fields.
struct Light {
    vec3 position;  // m
    uint type;
    vec3 to_light;  // unit length; for directional lights; for rectangles the direction opposite to
                    // their normal
    float radius;  // m, for spheres; rad, for directional lights; otherwise 0
    // Working colour, including the strength. A white matt surface that faces the light shows it at
    // reference_distance. For rectangles with a reference_distance it is their radiance.
    vec3 color;
    float reference_distance;  // m; 0 for directional lights
    vec3 half_width;  // m: from a rectangle's centre to the middle of a side
    vec3 half_height;  // m; cross(half_width, half_height) is along to_light
};

#endif
