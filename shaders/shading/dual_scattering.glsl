// Light that a fibre gets through other fibres: Zinke et al. 2008, Dual scattering approximation for
// fast multiple scattering in hair.
#ifndef HAIRBENCH_DUAL_SCATTERING_GLSL
#define HAIRBENCH_DUAL_SCATTERING_GLSL

#include "shading/fiber_bsdf.glsl"

// f |cos theta_i| of a fibre whose light has met `strands` others. Directions and h as in
// fiberBsdf().
vec3 dualScattering(PictureParameters picture, HairOptics optics, vec3 to_eye, vec3 to_light,
                    float h, float strands) {
    return vec3(0.0);
}

#endif
