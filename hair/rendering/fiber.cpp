#include "hair/rendering/fiber.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/trigonometric.hpp>

#include "engine/transfer.h"
#include "hair/rendering/render_assets.h"

namespace hair::rendering {
namespace {

// ---- One fibre ----------------------------------------------------------------------------------

constexpr double kPi = std::numbers::pi;

double square(double x) { return x * x; }

double logistic(double x, double scale) { return 1 / (1 + std::exp(-x / scale)); }

// ---- Many fibres --------------------------------------------------------------------------------

double mean(const glm::dvec3& color) { return (color.r + color.g + color.b) / 3; }

// Means weighted by the light that lobes or paths carry.
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

// ---- Buffers of shaders -------------------------------------------------------------------------

// Returns the optics of the settings' fibre, without the address of the averages.
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
        // The logistic distribution integrates to tanh(a / 2s) over [-a, a].
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

// Returns the averages that dual scattering looks up, over cos theta_i.
std::vector<gpu::FiberAverage> makeFiberAverages(const ShadingSettings& shading) {
    const Fiber fiber = makeFiber(shading);
    std::vector<gpu::FiberAverage> table;
    for (std::uint32_t i = 0; i < gpu::kFiberAverages; ++i) {
        const double cos_theta = static_cast<double>(i) / (gpu::kFiberAverages - 1);
        FiberAverages averages = averageOverFiber(fiber, std::acos(cos_theta));
        averages.forward *= double{shading.density_factor};
        averages.backward *= double{shading.density_factor};
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

double trimmedLogisticCdf(double x, double scale) {
    const double low = logistic(-kPi, scale);
    return (logistic(x, scale) - low) / (logistic(kPi, scale) - low);
}

double halfTurn(double x, double scale) {
    const double apart = std::abs(std::remainder(x, 2 * kPi));
    const double end = apart + kPi / 2;
    return trimmedLogisticCdf(std::min(end, kPi), scale) -
           trimmedLogisticCdf(apart - kPi / 2, scale) +
           (end > kPi ? trimmedLogisticCdf(end - 2 * kPi, scale) : 0.0);
}

FiberPath fiberPath(const Fiber& fiber, double theta_o, double h) {
    const double gamma_o = std::asin(std::clamp(h, -1.0, 1.0));
    const double cos_theta_t = std::sqrt(1 - square(std::sin(theta_o) / fiber.eta));
    // sin gamma_t = h / eta', where eta' is the refractive index in the plane across the fibre.
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

// ---- Many fibres --------------------------------------------------------------------------------

FiberAverages averageOverFiber(const Fiber& fiber, double theta) {
    constexpr int kPlaces = 256;
    FiberAverages averages;
    WeightedMeans forward_means;
    WeightedMeans backward_means;
    for (int i = 0; i < kPlaces; ++i) {
        // Steps are in gamma, h = sin gamma, because A_p has square roots of 1 - h^2. Both halves
        // of a fibre are alike.
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
            // Lobes with different shifts spread light, too.
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
        const double f = averages.forward[channel];
        const double passed = f * std::exp(f - 1);  // one fibre, out and in
        const double rest = std::max(1 - passed, 1e-9);
        const double inner = std::max(1 - f * f, 1e-9);
        const double once = b * passed / rest;
        const double thrice = b * b * b * passed / (rest * rest * inner);
        local.albedo[channel] = once + thrice;
        // Mean number of fibres that light passes forward: i on its way out and, for the light that
        // gets through a random number of fibres with mean i, i f on its way in. So it is the sum
        // over i of i (1 + f) passed^i, over the sum of passed^i. The same holds for three
        // scatterings backward.
        const double passes_once = (1 + f) / rest;
        const double passes_thrice = (1 + f) * (1 + passed) / rest + 2 * f * f / inner;
        means.add(
            once, averages.backward_shift + passes_once * averages.forward_shift,
            averages.backward_variance + passes_once * averages.forward_variance);
        means.add(
            thrice, 3 * averages.backward_shift + passes_thrice * averages.forward_shift,
            3 * averages.backward_variance + passes_thrice * averages.forward_variance);
    }
    local.shift = means.meanShift();
    // Where nothing comes back, the variance is that of one scattering, because shaders divide by
    // it.
    local.variance = means.weight > 0 ? means.meanVariance() : averages.backward_variance;
    return local;
}

// ---- Buffers of shaders -------------------------------------------------------------------------

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
