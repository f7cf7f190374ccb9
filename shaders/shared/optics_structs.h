#ifndef HAIRBENCH_OPTICS_STRUCTS_H
#define HAIRBENCH_OPTICS_STRUCTS_H

// A fibre's scattering, Chiang et al. 2016 in the notation of pbrt-v4. Lobes: R, TT, TRT, the rest.
struct HairOptics {
    vec3 absorption;  // sigma_a, per fibre radius
    float eta;  // refractive index
    vec4 variances;  // v_p, longitudinal, rad^2
    vec4 sin_tilts;  // sine of the angle that lobe p adds to theta_o
    vec4 cos_tilts;  // cosine of that angle
    float inverse_azimuthal_scale;  // 1 / s of the logistic distribution
    float trimmed;  // 1 over the logistic distribution's integral over [-pi, pi]
    float density_factor;  // d_f = d_b of dual scattering
    float unused;
    Address averages;  // FiberAverage [kFiberAverages]; read by dual_scattering
};

// Entries of the table of averages; cos theta_i goes from 0 to 1.
const uint kFiberAverages = 64u;

// Table entry for dual scattering; hair/rendering/fiber.h defines its members.
struct FiberAverage {
    vec4 forward;  // a_f; w: beta_f^2, rad^2
    vec4 local;  // A_b; w: its variance, rad^2
    vec2 shifts;  // mean of theta_i + theta_o, forward and local, rad
};

#endif
