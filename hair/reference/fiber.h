#pragma once

#include <span>

#include <glm/vec3.hpp>

#include "hair/rendering/fiber.h"

// How a fibre, alone or among others, scatters light from one direction to another, in double
// precision: what the device's shading models are held against. Directions, h and the papers are
// those of hair/rendering/fiber.h.
namespace hair::reference {

using rendering::Fiber;
using rendering::FiberAverages;

// M_p, d'Eon et al. 2011, An energy-conserving hair reflectance model: over theta_i, M_p cos
// theta_i integrates to 1. It is strongest at theta_i = -theta_o.
double longitudinal(double theta_i, double theta_o, double variance);

// The logistic distribution on [-pi, pi].
double trimmedLogistic(double x, double scale);

// f(wo, wi) |cos theta_i|: radiance towards wo from a light of unit irradiance on a plane that
// faces it. (|cos theta_i| cancels in it, which is why f itself is not asked for.)
glm::dvec3 scattering(const Fiber& fiber, const glm::dvec3& wo, const glm::dvec3& wi, double h);

// Importance sampling of wi: a lobe by its mean attenuation, then M_p and N_p exactly.
double samplingPdf(const Fiber& fiber, const glm::dvec3& wo, const glm::dvec3& wi, double h);
// `u`: four independent numbers in [0, 1).
glm::dvec3
sampleDirection(const Fiber& fiber, const glm::dvec3& wo, double h, std::span<const double, 4> u);

// Light that reaches a fibre behind others. Fibres are met independently, so their number has
// Poisson's distribution with mean `strands`.
struct GlobalScattering {
    double direct = 1;  // part that meets none: exp(-strands)
    glm::dvec3 forward{0};  // part scattered forward by all that it meets, one at least
    double shift = 0;  // mean of what theta_i changes by, rad
    double variance = 0;  // rad^2
};

GlobalScattering globalScattering(const FiberAverages& averages, double strands);

// What is round a fibre, as the light sees it.
struct Surroundings {
    double strands = 0;  // mean number before it
    double ended = 0;  // part of the light that those behind it would let through, there and back
    double returned = 0;  // what a surface behind those sends back of that part
};

// f |cos theta_i| of a fibre among others, with what the light loses on its way to it.
// `density_factor`: part of what a fibre scatters that meets others, d_f = d_b of each scattering.
glm::dvec3 dualScattering(
    const Fiber& fiber, double density_factor, const glm::dvec3& wo, const glm::dvec3& wi, double h,
    const Surroundings& around);

}  // namespace hair::reference
