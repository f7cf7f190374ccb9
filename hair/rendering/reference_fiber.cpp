#include "hair/rendering/reference_fiber.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/trigonometric.hpp>

#include "hair/rendering/hair_color.h"

namespace hair {

namespace {

constexpr double kPi = std::numbers::pi;

double square(double x) { return x * x; }

// ln I_0(x), x >= 0: its power series, or its asymptotic one, whose terms fall below 1e-17 before
// they grow again.
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

double logistic(double x, double scale) { return 1 / (1 + std::exp(-x / scale)); }

double inclination(const glm::dvec3& w) { return std::asin(std::clamp(w.x, -1.0, 1.0)); }
double azimuth(const glm::dvec3& w) { return std::atan2(w.z, w.y); }

// To [-pi, pi].
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

// M_p N_p of every lobe.
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

}  // namespace

Fiber makeFiber(const ShadingSettings& shading) {
    const double m = shading.longitudinal_roughness;
    const double n = shading.azimuthal_roughness;
    // The fits of Chiang et al. 2016, equations (7) and (8).
    const double v = square(0.726 * m + 0.812 * square(m) + 3.7 * std::pow(m, 20));
    const double s = std::sqrt(kPi / 8) * (0.265 * n + 1.194 * square(n) + 5.372 * std::pow(n, 22));
    const double tilt = glm::radians(static_cast<double>(shading.cuticle_tilt));
    return {
        .absorption = absorption(shading),
        .eta = shading.refractive_index,
        .variances = {v, v / 4, 4 * v, 4 * v},
        .shifts = {-2 * tilt, tilt, 4 * tilt, 0},
        .azimuthal_scale = s};
}

double fresnel(double cosine, double eta) {
    const double transmitted = std::sqrt(1 - (1 - square(cosine)) / square(eta));
    const double parallel = (eta * cosine - transmitted) / (eta * cosine + transmitted);
    const double across = (cosine - eta * transmitted) / (cosine + eta * transmitted);
    return (square(parallel) + square(across)) / 2;
}

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

double trimmedLogisticCdf(double x, double scale) {
    const double low = logistic(-kPi, scale);
    return (logistic(x, scale) - low) / (logistic(kPi, scale) - low);
}

FiberPath fiberPath(const Fiber& fiber, double theta_o, double h) {
    const double gamma_o = std::asin(std::clamp(h, -1.0, 1.0));
    const double cos_theta_t = std::sqrt(1 - square(std::sin(theta_o) / fiber.eta));
    // sin gamma_t = h / eta'; eta' is the index that the plane across sees.
    const double gamma_t =
        std::asin(h * std::cos(theta_o) / std::sqrt(square(fiber.eta) - square(std::sin(theta_o))));
    const glm::dvec3 transmitted =
        glm::exp(-fiber.absorption * (2 * std::cos(gamma_t) / cos_theta_t));
    const double f = fresnel(std::max(std::cos(theta_o) * std::cos(gamma_o), 1e-12), fiber.eta);

    FiberPath path;
    path.attenuations[0] = glm::dvec3(f);
    path.attenuations[1] = square(1 - f) * transmitted;
    path.attenuations[2] = path.attenuations[1] * transmitted * f;
    path.attenuations[3] = path.attenuations[2] * transmitted * f / (1.0 - transmitted * f);
    for (std::size_t p = 0; p < path.azimuths.size(); ++p) {
        const auto count = static_cast<double>(p);
        path.azimuths[p] = 2 * count * gamma_t - 2 * gamma_o + count * kPi;
    }
    return path;
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

}  // namespace hair
