#ifndef HAIRBENCH_OPTICS_STRUCTS_H
#define HAIRBENCH_OPTICS_STRUCTS_H

// A fibre's scattering, Chiang et al. 2016 in the notation of pbrt-v4. Lobes: R, TT, TRT, the rest.
struct HairOptics {
    vec3 absorption;  // sigma_a, per fibre radius
    float eta;  // refractive index
    vec4 variances;  // v_p, longitudinal
    vec4 sin_tilts;  // of what is added to theta_o in lobe p
    vec4 cos_tilts;
    float azimuthal_scale;  // s, of the logistic distribution
};

#endif
