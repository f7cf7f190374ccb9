// Reflection of meshes' surfaces: glTF 2.0, appendix B.
#ifndef HAIRBENCH_SURFACE_BRDF_GLSL
#define HAIRBENCH_SURFACE_BRDF_GLSL

// A surface; its colour is linear.
struct Surface {
    vec3 base_color;
    float metallic;
    float roughness;  // the square root of alpha
};

const float kSurfacePi = 3.14159265358979;
// A smoother surface reflects a light that is a point nowhere.
const float kSmoothest = 0.045;

const float kDielectric = 0.04;  // what it reflects straight back

// What a surface reflects straight back, and the color of what it scatters.
vec3 reflectance(Surface surface) {
    return mix(vec3(kDielectric), surface.base_color, surface.metallic);
}

vec3 scattered(Surface surface) { return surface.base_color * (1.0 - surface.metallic); }

// G / (4 |N.L| |N.V|), separable: Smith 1967, for one of the two directions.
float smithVisibility(float cosine, float alpha_squared) {
    return 1.0 / (cosine + sqrt(alpha_squared + (1.0 - alpha_squared) * cosine * cosine));
}

// f, 1/sr; all directions are unit vectors away from the surface. 0 for light from behind it.
vec3 surfaceBrdf(Surface surface, vec3 normal, vec3 to_eye, vec3 to_light) {
    float n_dot_l = dot(normal, to_light);
    if (n_dot_l <= 0.0) return vec3(0.0);
    vec3 middle = normalize(to_eye + to_light);
    float n_dot_h = clamp(dot(normal, middle), 0.0, 1.0);
    float v_dot_h = clamp(dot(to_eye, middle), 0.0, 1.0);
    float roughness = max(surface.roughness, kSmoothest);
    float alpha_squared = roughness * roughness * roughness * roughness;
    // Trowbridge and Reitz 1975, or GGX.
    float spread = n_dot_h * n_dot_h * (alpha_squared - 1.0) + 1.0;
    float distribution = alpha_squared / (kSurfacePi * spread * spread);
    float visible = smithVisibility(n_dot_l, alpha_squared) *
                    smithVisibility(abs(dot(normal, to_eye)), alpha_squared);
    // Schlick 1994; what a dielectric doesn't reflect it scatters.
    float grazing = pow(1.0 - v_dot_h, 5.0);
    vec3 straight = reflectance(surface);
    vec3 fresnel = straight + (1.0 - straight) * grazing;
    vec3 diffuse = (1.0 - kDielectric) * (1.0 - grazing) * scattered(surface) / kSurfacePi;
    return diffuse + fresnel * distribution * visible;
}

#endif
