#ifndef HAIRBENCH_ENVIRONMENT_STRUCTS_H
#define HAIRBENCH_ENVIRONMENT_STRUCTS_H

// Light from all around.
struct EnvironmentParameters {
    vec3 irradiance[9];  // spherical harmonics of irradiance / pi, l = 0 to 2 (Ramamoorthi and
                         // Hanrahan 2001), linear RGB, turned and scaled
};

#endif
