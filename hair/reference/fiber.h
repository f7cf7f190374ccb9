#pragma once

#include <span>

#include <glm/vec3.hpp>

#include "hair/rendering/fiber.h"

// Scattering of light by a fibre, alone or among others, from one direction to another, in double
// precision: a reference for the device's shading models. Directions, h and the papers are those of
// hair/rendering/fiber.h.
namespace hair::reference {

using rendering::Fiber;
using rendering::FiberAverages;

// M_p, d'Eon et al. 2011, An energy-conserving hair reflectance model: over theta_i,
// M_p cos theta_i integrates to 1. Its maximum is at theta_i = -theta_o.
double longitudinal(double theta_i, double theta_o, double variance);

// The logistic distribution on [-pi, pi].
double trimmedLogistic(double x, double scale);

// Returns f(wo, wi) |cos theta_i|: radiance towards wo from a light of unit irradiance on a plane
// that faces the light. (Not f itself, because |cos theta_i| cancels here.)
glm::dvec3 scattering(const Fiber& fiber, const glm::dvec3& wo, const glm::dvec3& wi, double h);

// Importance sampling of wi: picks a lobe by its mean attenuation, then samples M_p and N_p
// exactly.
double samplingPdf(const Fiber& fiber, const glm::dvec3& wo, const glm::dvec3& wi, double h);
// `u`: four independent numbers in [0, 1).
glm::dvec3
sampleDirection(const Fiber& fiber, const glm::dvec3& wo, double h, std::span<const double, 4> u);

// Light that reaches a fibre behind others. Fibres are hit independently, so their number has a
// Poisson distribution with mean `strands`.
struct GlobalScattering {
    double direct = 1;  // fraction that hits none: exp(-strands)
    glm::dvec3 forward{0};  // fraction scattered forward by all hit fibres, at least one
    double shift = 0;  // mean change of theta_i, rad
    double variance = 0;  // rad^2
};

GlobalScattering globalScattering(const FiberAverages& averages, double strands);

// Surroundings of a fibre, as seen by the light.
struct Surroundings {
    double strands = 0;  // mean number in front of it
    double ended = 0;  // fraction of light that the fibres behind would pass, there and back
    double returned = 0;  // part of that fraction that a surface behind them sends back
};

// Returns f |cos theta_i| of a fibre among others, including the light's losses on its way to it.
// `density_factor`: fraction of a fibre's scattered light that hits other fibres, d_f = d_b of each
// scattering.
glm::dvec3 dualScattering(
    const Fiber& fiber, double density_factor, const glm::dvec3& wo, const glm::dvec3& wi, double h,
    const Surroundings& around);

}  // namespace hair::reference
