#ifndef HAIRBENCH_MODEL_PROBE_STRUCTS_H
#define HAIRBENCH_MODEL_PROBE_STRUCTS_H

// What shading/probe_models.comp is asked about a point and a light, and what it says.
struct ModelProbe {
    vec3 position;  // m
    uint light;
    vec3 normal;  // unit length
    float exponent;
    vec3 tangent;  // unit length
    vec3 to_eye;   // unit length
    // The shader writes to_light and all members below it.
    vec3 to_light;  // unit length
    vec3 color;
    float angular_radius;  // rad
    float matt;  // mattResponse()
    float phong_diffuse;
    float phong_specular;
    float kajiya_kay_diffuse;
    float kajiya_kay_specular;
    float widened_exponent;
};

// Push constants of shading/probe_models.comp.
struct ProbeModelsPush {
    uint64_t lights;  // Light
    uint64_t probes;  // ModelProbe
    uint count;
};

#endif
