// Kajiya and Kay 1989, Rendering fur with three dimensional textures.
#ifndef HAIRBENCH_KAJIYA_KAY_GLSL
#define HAIRBENCH_KAJIYA_KAY_GLSL

struct KajiyaKayLight {
    float diffuse;   // sin(T, L)
    float specular;  // max(0, cos(T, L) cos(T, E) + sin(T, L) sin(T, E))^n
};

#endif
