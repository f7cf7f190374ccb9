#ifndef HAIRBENCH_ENVIRONMENT_STRUCTS_H
#define HAIRBENCH_ENVIRONMENT_STRUCTS_H

// Light from an environment map.
struct EnvironmentParameters {
    Address texels;  // vec3 [row][column], radiance, linear RGB with the strength, top row first
    uint width;  // px
    uint height;  // px
    float turn;  // rad, about +y
    vec3 irradiance[9];  // spherical harmonics of irradiance / pi, l = 0 to 2, m = -l to l
                         // (Ramamoorthi and Hanrahan 2001), linear RGB, turned and scaled
};

// Push constants of environment/*.
struct EnvironmentPush {
    Address picture;  // PictureParameters
    Address environment;  // EnvironmentParameters
};

#endif
