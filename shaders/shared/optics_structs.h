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
    float mean_row;  // row of the averages of the strands around; shaders set it
    float own_row;  // row of the strand's own averages; shaders set it
    float least_power;  // of row 0: strands/own_color.glsl
    float rows_per_power;
    vec3 body;  // factor on light that has been in the fibre: all except R. 1; shaders set it
    Address averages;  // FiberAverage [row][kFiberAverages]; read by dual_scattering
};

// Entries of a row of averages; cos theta_i goes from 0 to 1.
const uint kFiberAverages = 64u;
// Rows if strands have their own colours, in equal steps of the power; otherwise there is one row.
const uint kFiberAverageRows = 16u;

// Table entry for dual scattering; hair/rendering/fiber.h defines its members.
struct FiberAverage {
    vec4 forward;  // a_f; w: beta_f^2, rad^2
    vec4 local;  // A_b; w: its variance, rad^2
    vec2 shifts;  // mean of theta_i + theta_o, forward and local, rad
    vec3 own;  // a_f of a strand of this row's power; the others are means over strands
};

#endif
