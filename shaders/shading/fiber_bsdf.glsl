// Scattering of one fibre, Chiang et al. 2016, in the notation of pbrt-v4.
#ifndef HAIRBENCH_FIBER_BSDF_GLSL
#define HAIRBENCH_FIBER_BSDF_GLSL

#include "common/picture.glsl"

layout(buffer_reference, scalar) readonly buffer HairOpticsReference { HairOptics optics; };

// f of pbrt-v4: radiance = sum over lights of f |cos theta_i| times irradiance across the fibre.
// Directions are unit vectors away from the fibre, x along it towards the tip; h in [-1, 1] is the
// place across it, seen from `to_eye`.
vec3 fiberBsdf(HairOptics optics, vec3 to_eye, vec3 to_light, float h) { return vec3(0.0); }

#endif
