#pragma once

#include "hair/rendering/reference_fiber.h"

// Light that many fibres scatter, in double precision: Zinke, Yuksel, Weber and Keyser 2008, Dual
// scattering approximation for fast multiple scattering in hair. Forward is away from the light:
// the half turn of azimuths round phi_i + pi.
namespace hair {

// Averages over the width of a fibre and over a half turn, for light at an angle theta with the
// plane across the fibre.
struct FiberAverages {
    glm::dvec3 forward{0};   // a_f, equation (6): part of the light that goes on forward
    glm::dvec3 backward{0};  // a_b, equation (12)
    double forward_shift = 0;  // mean of theta_i + theta_o, rad
    double backward_shift = 0;
    double forward_variance = 0;  // beta_f^2, rad^2: variances add up, so they are averaged
    double backward_variance = 0;
};

FiberAverages averageOverFiber(const Fiber& fiber, double theta);

// What light that passes a fibre forward, is scattered backward behind it once or three times and
// passes it again adds to the fibre's own.
struct LocalScattering {
    glm::dvec3 albedo{0};  // A_b, equations (13) to (15)
    double shift = 0;      // mean of theta_i + theta_o, rad
    double variance = 0;   // rad^2
};

// Shift and variance are the means over the series of (14) and (15), of which the paper's (16) and
// (17) are approximations.
LocalScattering localScattering(const FiberAverages& averages);

// Light that reaches a fibre behind others. Fibres are met independently, so their number has
// Poisson's distribution with mean `strands`.
struct GlobalScattering {
    double direct = 1;         // part that meets none: exp(-strands)
    glm::dvec3 forward{0};     // part scattered forward by all that it meets, one at least
    double shift = 0;          // mean of what theta_i changes by, rad
    double variance = 0;       // rad^2
};

GlobalScattering globalScattering(const FiberAverages& averages, double strands);

// f |cos theta_i| of a fibre among others, with what the light loses on its way to it.
// `density_factor`: d_f = d_b.
glm::dvec3 dualScattering(
    const Fiber& fiber, double density_factor, const glm::dvec3& wo, const glm::dvec3& wi, double h,
    double strands);

}  // namespace hair
