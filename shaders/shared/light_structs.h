#ifndef HAIRBENCH_LIGHT_STRUCTS_H
#define HAIRBENCH_LIGHT_STRUCTS_H

const uint kLightPoint = 0u;
const uint kLightDirectional = 1u;
const uint kLightSphere = 2u;
const uint kLightRectangle = 3u;

// Kinds of lights beside the thesis's, points of the same strength everywhere: bits of kLightKinds
// in shading/options.glsl.
const uint kSomeDirectional = 1u;
const uint kSomeSpheres = 2u;  // or directional ones that are no points
const uint kSomeWeaken = 4u;  // with distance
const uint kSomeRectangles = 8u;
const uint kSomeSampled = 16u;  // by several shadow maps
const uint kAllLightKinds = 31u;

// A light of the picture: settings of the same names say what they are.
struct Light {
    vec3 position;  // m
    uint type;
    vec3 to_light;  // unit length; of directional ones and, against their normal, of rectangles
    float radius;  // m, of spheres; rad, of directional ones; else 0
    // Working colours, with the strength: what a white matt surface that faces the light shows at
    // reference_distance; the radiance of rectangles that have a reference_distance.
    vec3 color;
    float reference_distance;  // m; 0 of directional ones
    vec3 half_width;  // m: of a rectangle, from its middle to that of a side
    vec3 half_height;  // m; cross(half_width, half_height) is along to_light
};

#endif
