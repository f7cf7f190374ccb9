// Phong's model, thesis equations (5) and (6).
#ifndef HAIRBENCH_PHONG_GLSL
#define HAIRBENCH_PHONG_GLSL

struct PhongLight {
    float diffuse;   // N . L
    float specular;  // (E . R)^n
};

// All directions are unit vectors that point away from the surface.
PhongLight phong(vec3 normal, vec3 to_light, vec3 to_eye, float exponent) {
    float n_dot_l = dot(normal, to_light);
    vec3 reflected = 2.0 * n_dot_l * normal - to_light;
    PhongLight light;
    light.diffuse = max(n_dot_l, 0.0);
    light.specular = n_dot_l > 0.0 ? pow(max(dot(to_eye, reflected), 0.0), exponent) : 0.0;
    return light;
}

#endif
