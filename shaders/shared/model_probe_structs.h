#ifndef HAIRBENCH_MODEL_PROBE_STRUCTS_H
#define HAIRBENCH_MODEL_PROBE_STRUCTS_H

// What shading/probe_models.comp is asked about a point and a light, and what it says.
struct ModelProbe {
    vec3 position;  // m
    uint light;
    vec3 normal;  // unit length, as the next two
    float exponent;
    vec3 tangent;
    vec3 to_eye;
    vec3 to_light;  // written, as all that follows
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
