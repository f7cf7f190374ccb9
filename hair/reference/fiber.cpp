#include "hair/reference/fiber.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/trigonometric.hpp>

namespace hair::reference {
namespace {

using rendering::FiberPath;
using rendering::kFiberLobes;
using rendering::LocalScattering;
using rendering::PerLobe;

constexpr double kPi = std::numbers::pi;

double square(double x) { return x * x; }

double mean(const glm::dvec3& color) { return (color.r + color.g + color.b) / 3; }

double logistic(double x, double scale) { return 1 / (1 + std::exp(-x / scale)); }

// Returns ln I_0(x), x >= 0, by its power series or its asymptotic one. The terms of the latter
// fall below 1e-17 before they grow again.
double logBessel0(double x) {
    double term = 1;
    double sum = 1;
    const bool small = x < 20;
    for (int k = 1; k < 200 && term > 1e-17 * sum; ++k) {
        term *= small ? square(x / (2 * k)) : square(2 * k - 1) / (8 * k * x);
        sum += term;
    }
    return small ? std::log(sum) : x - 0.5 * std::log(2 * kPi * x) + std::log(sum);
}

double inclination(const glm::dvec3& w) { return std::asin(std::clamp(w.x, -1.0, 1.0)); }
double azimuth(const glm::dvec3& w) { return std::atan2(w.z, w.y); }

// Returns the equivalent angle in [-pi, pi].
double wrapped(double angle) { return std::remainder(angle, 2 * kPi); }

PerLobe<double> lobeProbabilities(const FiberPath& path) {
    PerLobe<double> probabilities;
    double sum = 0;
    for (std::size_t p = 0; p < kFiberLobes; ++p) {
        const glm::dvec3& a = path.attenuations[p];
        probabilities[p] = (a.r + a.g + a.b) / 3;
        sum += probabilities[p];
    }
    for (double& probability : probabilities) probability /= sum;
    return probabilities;
}

// Returns M_p N_p of every lobe.
PerLobe<double>
lobes(const Fiber& fiber, const FiberPath& path, const glm::dvec3& wo, const glm::dvec3& wi) {
    const double phi = azimuth(wi) - azimuth(wo);
    PerLobe<double> values;
    for (std::size_t p = 0; p < kFiberLobes; ++p) {
        const double m =
            longitudinal(inclination(wi), inclination(wo) - fiber.shifts[p], fiber.variances[p]);
        const double n =
            p < path.azimuths.size()
                ? trimmedLogistic(wrapped(phi - path.azimuths[p]), fiber.azimuthal_scale)
                : 1 / (2 * kPi);
        values[p] = m * n;
    }
    return values;
}

// Returns the sum of all lobes for light from inclination theta_i, with the factors `azimuthal`.
template <class Azimuthal>
glm::dvec3 sumOfLobes(
    const Fiber& fiber, const FiberPath& path, double theta_i, double theta_o, double more_variance,
    const Azimuthal& azimuthal) {
    glm::dvec3 sum(0);
    for (std::size_t p = 0; p < kFiberLobes; ++p) {
        const double m =
            longitudinal(theta_i, theta_o - fiber.shifts[p], fiber.variances[p] + more_variance);
        sum += path.attenuations[p] * (m * azimuthal(p));
    }
    return sum;
}

}  // namespace

double longitudinal(double theta_i, double theta_o, double variance) {
    const double a = std::abs(std::cos(theta_i) * std::cos(theta_o)) / variance;
    const double b = std::sin(theta_i) * std::sin(theta_o) / variance;
    // M = e^-b I_0(a) / (2 v sinh(1/v)); 2 sinh(1/v) = e^(1/v) (1 - e^(-2/v)), so that nothing
    // overflows for small v.
    return std::exp(logBessel0(a) - b - 1 / variance) / (variance * -std::expm1(-2 / variance));
}

double trimmedLogistic(double x, double scale) {
    const double e = std::exp(-std::abs(x) / scale);
    return e / (scale * square(1 + e)) / (logistic(kPi, scale) - logistic(-kPi, scale));
}

glm::dvec3 scattering(const Fiber& fiber, const glm::dvec3& wo, const glm::dvec3& wi, double h) {
    const FiberPath path = fiberPath(fiber, inclination(wo), h);
    const PerLobe<double> values = lobes(fiber, path, wo, wi);
    glm::dvec3 sum(0);
    for (std::size_t p = 0; p < kFiberLobes; ++p) sum += path.attenuations[p] * values[p];
    return sum;
}

double samplingPdf(const Fiber& fiber, const glm::dvec3& wo, const glm::dvec3& wi, double h) {
    const FiberPath path = fiberPath(fiber, inclination(wo), h);
    const PerLobe<double> values = lobes(fiber, path, wo, wi);
    const PerLobe<double> probabilities = lobeProbabilities(path);
    double sum = 0;
    for (std::size_t p = 0; p < kFiberLobes; ++p) sum += probabilities[p] * values[p];
    return sum;
}

glm::dvec3
sampleDirection(const Fiber& fiber, const glm::dvec3& wo, double h, std::span<const double, 4> u) {
    const FiberPath path = fiberPath(fiber, inclination(wo), h);
    const PerLobe<double> probabilities = lobeProbabilities(path);
    std::size_t p = 0;
    for (double left = u[0]; p + 1 < kFiberLobes && left >= probabilities[p]; ++p)
        left -= probabilities[p];

    // M_p is a von Mises-Fisher distribution round the mirror image of wo, turned about the fibre.
    const double v = fiber.variances[p];
    const double theta = inclination(wo) - fiber.shifts[p];
    const double cosine = 1 + v * std::log(u[1] + (1 - u[1]) * std::exp(-2 / v));
    const double sine = std::sqrt(std::max(1 - square(cosine), 0.0));
    const double sin_i = std::clamp(
        -cosine * std::sin(theta) + sine * std::cos(2 * kPi * u[2]) * std::abs(std::cos(theta)),
        -1.0, 1.0);
    const double cos_i = std::sqrt(1 - square(sin_i));

    double phi = azimuth(wo);
    if (p < path.azimuths.size()) {
        const double s = fiber.azimuthal_scale;
        const double low = logistic(-kPi, s);
        const double cdf = low + u[3] * (logistic(kPi, s) - low);
        phi += path.azimuths[p] - s * std::log(1 / cdf - 1);
    } else {
        phi += 2 * kPi * u[3];
    }
    return {sin_i, cos_i * std::cos(phi), cos_i * std::sin(phi)};
}

GlobalScattering globalScattering(const FiberAverages& averages, double strands) {
    GlobalScattering global;
    if (strands <= 0) return global;
    global.direct = std::exp(-strands);
    // The expectation of a_f^N is exp(-n (1 - a_f)).
    global.forward = glm::exp(-strands * (1.0 - averages.forward)) - global.direct;
    // The mean of N, if it is not 0, weighted by a_f^N.
    const double passed = std::max(strands * mean(averages.forward), 1e-9);
    const double met = passed / -std::expm1(-passed);
    global.shift = met * averages.forward_shift;
    global.variance = met * averages.forward_variance;
    return global;
}

glm::dvec3 dualScattering(
    const Fiber& fiber, double density_factor, const glm::dvec3& wo, const glm::dvec3& wi, double h,
    const Surroundings& around) {
    const double theta_i = std::asin(std::clamp(wi.x, -1.0, 1.0));
    const double theta_o = std::asin(std::clamp(wo.x, -1.0, 1.0));
    const double phi = std::atan2(wi.z, wi.y) - std::atan2(wo.z, wo.y);
    const FiberPath path = fiberPath(fiber, theta_o, h);
    FiberAverages averages = averageOverFiber(fiber, theta_i);
    averages.forward *= density_factor;
    averages.backward *= density_factor;
    const LocalScattering local = localScattering(averages);
    const GlobalScattering global = globalScattering(averages, around.strands);
    const glm::dvec3 albedo =
        (1 - around.ended) * local.albedo + around.returned * averages.forward;

    // Twice A_b, as in equation (11), round the light's direction: (1 + cos phi) / 2 pi instead of
    // 1 / pi in the nearer half turn, which would have a sharp edge.
    const auto behind = [&](double change, double more_variance, double azimuthal) {
        return 2.0 * azimuthal * albedo *
               longitudinal(
                   theta_i - change - local.shift, theta_o, local.variance + more_variance);
    };
    const glm::dvec3 direct =
        scattering(fiber, wo, wi, h) + behind(0, 0, (1 + std::cos(phi)) / (2 * kPi));
    // S_f: the light is spread uniformly over the half turn round phi_i.
    const glm::dvec3 scattered =
        sumOfLobes(
            fiber, path, theta_i - global.shift, theta_o, global.variance,
            [&](std::size_t p) {
                return p < path.azimuths.size()
                           ? rendering::halfTurn(phi - path.azimuths[p], fiber.azimuthal_scale) /
                                 kPi
                           : 1 / (2 * kPi);
            }) +
        behind(global.shift, global.variance, (1 + 2 / kPi * std::cos(phi)) / (2 * kPi));
    return global.direct * direct + global.forward * scattered;
}

}  // namespace hair::reference
