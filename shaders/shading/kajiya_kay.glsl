// Kajiya and Kay 1989, Rendering fur with three dimensional textures.
#ifndef HAIRBENCH_KAJIYA_KAY_GLSL
#define HAIRBENCH_KAJIYA_KAY_GLSL

struct KajiyaKayLight {
    float diffuse;   // sin(T, L)
    float specular;  // max(0, cos(T, L) cos(T, E) + sin(T, L) sin(T, E))^n
};

// All directions are unit vectors that point away from the strand; the tangent points along it. L
// in the equations is the direction in which light travels, so the specular term is greatest if the
// eye is on the cone of mirrored light.
KajiyaKayLight kajiyaKay(vec3 tangent, vec3 to_light, vec3 to_eye, float exponent) {
    float cos_light = -dot(tangent, to_light);
    float cos_eye = dot(tangent, to_eye);
    float sin_light = sqrt(max(1.0 - cos_light * cos_light, 0.0));
    float sin_eye = sqrt(max(1.0 - cos_eye * cos_eye, 0.0));
    KajiyaKayLight light;
    light.diffuse = sin_light;
    light.specular = pow(max(cos_light * cos_eye + sin_light * sin_eye, 0.0), exponent);
    return light;
}

#endif
