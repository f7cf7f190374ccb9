#include "hair/rendering/fiber.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/trigonometric.hpp>

#include "hair/rendering/render_assets.h"

namespace hair::rendering {
namespace {

// ---- One fibre ----------------------------------------------------------------------------------

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

// The same angle in [-pi, pi].
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

// ---- Many fibres --------------------------------------------------------------------------------

double mean(const glm::dvec3& color) { return (color.r + color.g + color.b) / 3; }

// What N_p has in the half turn round an azimuth that is `x` from Phi(p).
double halfTurn(double x, double scale) {
    const double apart = std::abs(std::remainder(x, 2 * kPi));
    const double end = apart + kPi / 2;
    return trimmedLogisticCdf(std::min(end, kPi), scale) -
           trimmedLogisticCdf(apart - kPi / 2, scale) +
           (end > kPi ? trimmedLogisticCdf(end - 2 * kPi, scale) : 0.0);
}

// Means that are weighted by what lobes or paths carry.
struct WeightedMeans {
    double weight = 0;
    double shift = 0;
    double variance = 0;

    void add(double more, double its_shift, double its_variance) {
        weight += more;
        shift += more * its_shift;
        variance += more * its_variance;
    }
    double meanShift() const { return weight > 0 ? shift / weight : 0; }
    double meanVariance() const { return weight > 0 ? variance / weight : 0; }
};

// Every lobe, with light from inclination theta_i and, round the eye, the azimuths of `azimuthal`.
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

// ---- What shaders read --------------------------------------------------------------------------

// What a fibre scatters, as the settings say, without the address of the averages.
gpu::HairOptics makeHairOptics(const ShadingSettings& shading) {
    const Fiber fiber = makeFiber(shading);
    const double s = fiber.azimuthal_scale;
    gpu::HairOptics optics{
        .absorption = fiber.absorption,
        .eta = static_cast<float>(fiber.eta),
        .variances = {},
        .sin_tilts = {},
        .cos_tilts = {},
        .inverse_azimuthal_scale = static_cast<float>(1 / s),
        // The logistic distribution has tanh(a / 2s) in [-a, a].
        .trimmed = static_cast<float>(1 / std::tanh(std::numbers::pi / (2 * s))),
        .density_factor = shading.density_factor,
        .unused = 0,
        .averages = 0};
    for (int p = 0; p < 4; ++p) {
        const auto lobe = static_cast<std::size_t>(p);
        optics.variances[p] = static_cast<float>(fiber.variances[lobe]);
        optics.sin_tilts[p] = static_cast<float>(std::sin(-fiber.shifts[lobe]));
        optics.cos_tilts[p] = static_cast<float>(std::cos(-fiber.shifts[lobe]));
    }
    return optics;
}

// The averages that dual scattering looks up, over cos theta_i.
std::vector<gpu::FiberAverage> makeFiberAverages(const ShadingSettings& shading) {
    const Fiber fiber = makeFiber(shading);
    std::vector<gpu::FiberAverage> table;
    for (std::uint32_t i = 0; i < gpu::kFiberAverages; ++i) {
        const double cos_theta = static_cast<double>(i) / (gpu::kFiberAverages - 1);
        const FiberAverages averages = averageOverFiber(fiber, std::acos(cos_theta));
        const LocalScattering local = localScattering(averages);
        table.push_back(
            {.forward = glm::dvec4(averages.forward, averages.forward_variance),
             .local = glm::dvec4(local.albedo, local.variance),
             .shifts = glm::dvec2(averages.forward_shift, local.shift)});
    }
    return table;
}

}  // namespace

// ---- One fibre ----------------------------------------------------------------------------------

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

// ---- Many fibres --------------------------------------------------------------------------------

FiberAverages averageOverFiber(const Fiber& fiber, double theta) {
    constexpr int kPlaces = 256;
    FiberAverages averages;
    WeightedMeans forward_means;
    WeightedMeans backward_means;
    for (int i = 0; i < kPlaces; ++i) {
        // h = sin gamma, for A_p has square roots of 1 - h^2; both halves of a fibre are alike.
        const double step = kPi / 2 / kPlaces;
        const double gamma = (i + 0.5) * step;
        const double width = std::sin(gamma + step / 2) - std::sin(gamma - step / 2);
        const FiberPath path = fiberPath(fiber, theta, std::sin(gamma));
        for (std::size_t p = 0; p < kFiberLobes; ++p) {
            const double forward = p < path.azimuths.size()
                                       ? halfTurn(kPi - path.azimuths[p], fiber.azimuthal_scale)
                                       : 0.5;
            const glm::dvec3 carried = width * path.attenuations[p];
            averages.forward += forward * carried;
            averages.backward += (1 - forward) * carried;
            // Lobes in different places spread light too.
            const double shift = fiber.shifts[p];
            const double spread = fiber.variances[p] + square(shift);
            forward_means.add(forward * mean(carried), shift, spread);
            backward_means.add((1 - forward) * mean(carried), shift, spread);
        }
    }
    averages.forward_shift = forward_means.meanShift();
    averages.backward_shift = backward_means.meanShift();
    averages.forward_variance = forward_means.meanVariance() - square(averages.forward_shift);
    averages.backward_variance = backward_means.meanVariance() - square(averages.backward_shift);
    return averages;
}

LocalScattering localScattering(const FiberAverages& averages) {
    LocalScattering local;
    WeightedMeans means;
    for (int channel = 0; channel < 3; ++channel) {
        const double b = averages.backward[channel];
        const double passed = square(averages.forward[channel]);
        const double rest = std::max(1 - passed, 1e-9);
        const double once = b * passed / rest;
        const double thrice = b * b * b * passed / (rest * rest * rest);
        local.albedo[channel] = once + thrice;
        // Fibres that are passed forward: sum over i of 2 i a^(2 i), over sum of a^(2 i); and the
        // same for three scatterings backward, whose series is a^2 / (1 - a^2)^3.
        const double passes_once = 2 / rest;
        const double passes_thrice = 2 * (1 + 2 * passed) / rest;
        means.add(
            once, averages.backward_shift + passes_once * averages.forward_shift,
            averages.backward_variance + passes_once * averages.forward_variance);
        means.add(
            thrice, 3 * averages.backward_shift + passes_thrice * averages.forward_shift,
            3 * averages.backward_variance + passes_thrice * averages.forward_variance);
    }
    local.shift = means.meanShift();
    local.variance = means.meanVariance();
    return local;
}

GlobalScattering globalScattering(const FiberAverages& averages, double strands) {
    GlobalScattering global;
    if (strands <= 0) return global;
    global.direct = std::exp(-strands);
    // The expectation of a_f^N is exp(-n (1 - a_f)).
    global.forward = glm::exp(-strands * (1.0 - averages.forward)) - global.direct;
    // The mean of N where it is not 0, weighted by a_f^N.
    const double passed = std::max(strands * mean(averages.forward), 1e-9);
    const double met = passed / -std::expm1(-passed);
    global.shift = met * averages.forward_shift;
    global.variance = met * averages.forward_variance;
    return global;
}

glm::dvec3 dualScattering(
    const Fiber& fiber, double density_factor, const glm::dvec3& wo, const glm::dvec3& wi, double h,
    double strands) {
    const double theta_i = std::asin(std::clamp(wi.x, -1.0, 1.0));
    const double theta_o = std::asin(std::clamp(wo.x, -1.0, 1.0));
    const double phi = std::atan2(wi.z, wi.y) - std::atan2(wo.z, wo.y);
    const FiberPath path = fiberPath(fiber, theta_o, h);
    const FiberAverages averages = averageOverFiber(fiber, theta_i);
    const LocalScattering local = localScattering(averages);
    const GlobalScattering global = globalScattering(averages, strands);

    // Twice A_b, as in equation (11), round the direction of the light: (1 + cos phi) / 2 pi
    // instead of 1 / pi in the nearer half turn, which would end in an edge.
    const auto behind = [&](double change, double more_variance, double azimuthal) {
        return 2.0 * density_factor * azimuthal * local.albedo *
               longitudinal(
                   theta_i - change - local.shift, theta_o, local.variance + more_variance);
    };
    const glm::dvec3 direct =
        scattering(fiber, wo, wi, h) + behind(0, 0, (1 + std::cos(phi)) / (2 * kPi));
    // S_f: the light is spread evenly over the half turn round phi_i.
    const glm::dvec3 scattered =
        sumOfLobes(
            fiber, path, theta_i - global.shift, theta_o, global.variance,
            [&](std::size_t p) {
                return p < path.azimuths.size()
                           ? halfTurn(phi - path.azimuths[p], fiber.azimuthal_scale) / kPi
                           : 1 / (2 * kPi);
            }) +
        behind(global.shift, global.variance, (1 + 2 / kPi * std::cos(phi)) / (2 * kPi));
    return global.direct * direct + density_factor * global.forward * scattered;
}

// ---- What shaders read --------------------------------------------------------------------------

// Scalar layout aligns 64-bit members to 8, as C++ does.
static_assert(offsetof(gpu::HairOptics, averages) == 80 && sizeof(gpu::HairOptics) == 88);
static_assert(sizeof(gpu::FiberAverage) == 40);

HairOpticsBuffers::HairOpticsBuffers(const engine::Device& device, const Settings& settings) {
    gpu::HairOptics optics = makeHairOptics(settings.shading);
    if (settings.shading.model == ShadingModel::dual_scattering) {
        const std::vector<gpu::FiberAverage> table = makeFiberAverages(settings.shading);
        averages_ = engine::makeBuffer(device, std::span(table), "fiber averages");
        optics.averages = averages_.address();
    }
    optics_ =
        engine::makeBuffer(device, std::span<const gpu::HairOptics>(&optics, 1), "hair optics");
}

}  // namespace hair::rendering
