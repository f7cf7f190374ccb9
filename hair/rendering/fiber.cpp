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

// The path of a ray in a fibre, without its absorption.
struct FiberWay {
    double fresnel = 0;
    double length = 0;  // of a path through the fibre, in radii
    std::array<double, 3> azimuths{};  // FiberPath::azimuths
};

FiberWay fiberWay(const Fiber& fiber, double theta_o, double h) {
    const double gamma_o = std::asin(std::clamp(h, -1.0, 1.0));
    const double cos_theta_t = std::sqrt(1 - square(std::sin(theta_o) / fiber.eta));
    // sin gamma_t = h / eta', where eta' is the refractive index in the plane across the fibre.
    const double gamma_t =
        std::asin(h * std::cos(theta_o) / std::sqrt(square(fiber.eta) - square(std::sin(theta_o))));
    FiberWay way;
    way.length = 2 * std::cos(gamma_t) / cos_theta_t;
    way.fresnel = fresnel(std::max(std::cos(theta_o) * std::cos(gamma_o), 1e-12), fiber.eta);
    for (std::size_t p = 0; p < way.azimuths.size(); ++p) {
        const auto count = static_cast<double>(p);
        way.azimuths[p] = 2 * count * gamma_t - 2 * gamma_o + count * kPi;
    }
    return way;
}

// A_p, with the part of light that is left after a path through the fibre.
PerLobe<glm::dvec3> lobeAttenuations(double fresnel, const glm::dvec3& transmitted) {
    PerLobe<glm::dvec3> attenuations;
    attenuations[0] = glm::dvec3(fresnel);
    attenuations[1] = square(1 - fresnel) * transmitted;
    attenuations[2] = attenuations[1] * transmitted * fresnel;
    attenuations[3] = attenuations[2] * transmitted * fresnel / (1.0 - transmitted * fresnel);
    return attenuations;
}

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
        .mean_row = 0,
        .own_row = 0,
        .least_power = 0,
        .rows_per_power = 0,
        .body = glm::vec3(1),
        .averages = 0};
    const OwnPowers powers = ownPowers(shading);
    if (powers.greatest > powers.least) {
        optics.least_power = static_cast<float>(powers.least);
        optics.rows_per_power =
            static_cast<float>((gpu::kFiberAverageRows - 1) / (powers.greatest - powers.least));
    }
    for (int p = 0; p < 4; ++p) {
        const auto lobe = static_cast<std::size_t>(p);
        optics.variances[p] = static_cast<float>(fiber.variances[lobe]);
        optics.sin_tilts[p] = static_cast<float>(std::sin(-fiber.shifts[lobe]));
        optics.cos_tilts[p] = static_cast<float>(std::cos(-fiber.shifts[lobe]));
    }
    return optics;
}

// A part of the width of a fibre, for light at one angle.
struct FiberSlice {
    double width = 0;
    double fresnel = 0;
    double length = 0;  // of a path through the fibre, in radii
    PerLobe<double> forward{};  // the part of each lobe that goes on forward
    // Variance of theta_i + theta_o that fibres with other directions add to each lobe, rad^2.
    PerLobe<double> forward_tilt{};
    PerLobe<double> backward_tilt{};
};

// Strands of one absorption, and their share of all strands.
struct AbsorptionShare {
    glm::dvec3 absorption{0};
    double share = 1;
};

// Means of a lobe's 2 (1 + cos phi), where phi is the azimuth between the light's source and the
// direction of the scattered light.
struct AzimuthMeans {
    double forward = 0;  // over the half turn away from the light
    double backward = 0;
};

AzimuthMeans azimuthMeans(const Fiber& fiber, double lobe_azimuth) {
    constexpr int kParts = 32;  // of equal light
    const double low = logistic(-kPi, fiber.azimuthal_scale);
    const double high = logistic(kPi, fiber.azimuthal_scale);
    AzimuthMeans sums;
    int forward = 0;
    for (int i = 0; i < kParts; ++i) {
        const double cdf = low + (high - low) * (i + 0.5) / kParts;
        const double cosine =
            std::cos(lobe_azimuth - fiber.azimuthal_scale * std::log(1 / cdf - 1));
        (cosine < 0 ? sums.forward : sums.backward) += 2 * (1 + cosine);
        forward += cosine < 0 ? 1 : 0;
    }
    sums.forward /= std::max(forward, 1);
    sums.backward /= std::max(kParts - forward, 1);
    return sums;
}

// A fibre whose direction differs by a small angle delta, as a vector, sends light into the cone
// theta_o = -theta_i round its own axis. Round the first fibre, theta_i + theta_o then changes by
// the component of delta along the sum of both azimuths' unit vectors, whose squared length is
// 2 (1 + cos phi): by nothing if the light goes straight on, by 2 delta if it turns back.
void addTilts(const Fiber& fiber, std::span<const double> azimuths, FiberSlice& slice) {
    for (std::size_t p = 0; p < kFiberLobes; ++p) {
        const double even = 4 / kPi;  // of 2 cos phi over a half turn
        AzimuthMeans means{2 - even, 2 + even};
        if (p < azimuths.size()) means = azimuthMeans(fiber, azimuths[p]);
        slice.forward_tilt[p] = fiber.tilt_variance * means.forward;
        slice.backward_tilt[p] = fiber.tilt_variance * means.backward;
    }
}

std::vector<FiberSlice> slicesOf(const Fiber& fiber, double theta) {
    constexpr int kPlaces = 256;
    std::vector<FiberSlice> slices;
    for (int i = 0; i < kPlaces; ++i) {
        // Steps are in gamma, h = sin gamma, because A_p has square roots of 1 - h^2. Both halves
        // of a fibre are alike.
        const double step = kPi / 2 / kPlaces;
        const double gamma = (i + 0.5) * step;
        const FiberWay way = fiberWay(fiber, theta, std::sin(gamma));
        FiberSlice& slice = slices.emplace_back();
        slice.width = std::sin(gamma + step / 2) - std::sin(gamma - step / 2);
        slice.fresnel = way.fresnel;
        slice.length = way.length;
        for (std::size_t p = 0; p < kFiberLobes; ++p)
            slice.forward[p] = p < way.azimuths.size()
                                   ? halfTurn(kPi - way.azimuths[p], fiber.azimuthal_scale)
                                   : 0.5;
        if (fiber.tilt_variance > 0) addTilts(fiber, way.azimuths, slice);
    }
    return slices;
}

// Returns the averages over the width and over strands of several absorptions.
FiberAverages averageOverSlices(
    const Fiber& fiber, std::span<const FiberSlice> slices,
    std::span<const AbsorptionShare> shares) {
    FiberAverages averages;
    WeightedMeans forward_means;
    WeightedMeans backward_means;
    for (const AbsorptionShare& strands : shares) {
        for (const FiberSlice& slice : slices) {
            const PerLobe<glm::dvec3> attenuations =
                lobeAttenuations(slice.fresnel, glm::exp(-strands.absorption * slice.length));
            for (std::size_t p = 0; p < kFiberLobes; ++p) {
                const double forward = slice.forward[p];
                const glm::dvec3 carried = strands.share * slice.width * attenuations[p];
                averages.forward += forward * carried;
                averages.backward += (1 - forward) * carried;
                // Lobes with different shifts spread light, too.
                const double shift = fiber.shifts[p];
                const double spread = fiber.variances[p] + square(shift);
                forward_means.add(forward * mean(carried), shift, spread + slice.forward_tilt[p]);
                backward_means.add(
                    (1 - forward) * mean(carried), shift, spread + slice.backward_tilt[p]);
            }
        }
    }
    averages.forward_shift = forward_means.meanShift();
    averages.backward_shift = backward_means.meanShift();
    averages.forward_variance = forward_means.meanVariance() - square(averages.forward_shift);
    averages.backward_variance = backward_means.meanVariance() - square(averages.backward_shift);
    return averages;
}

// Returns the strands round one with this mean power: three powers that stand for all between
// mean (1 - variation) and mean (1 + variation), by Gauss and Legendre's rule.
std::vector<AbsorptionShare>
strandsAround(const glm::dvec3& absorption, double mean_power, double variation) {
    if (variation == 0) return {{square(mean_power) * absorption, 1}};
    std::vector<AbsorptionShare> shares;
    for (const double place : {-1.0, 0.0, 1.0}) {
        const double power = mean_power * (1 + variation * place * std::sqrt(0.6));
        shares.push_back({square(power) * absorption, place == 0.0 ? 8.0 / 18.0 : 5.0 / 18.0});
    }
    return shares;
}

// Returns the averages that dual scattering looks up, row by row over cos theta_i.
namespace {

std::uint32_t averageRows(const OwnPowers& powers) {
    return powers.greatest > powers.least ? gpu::kFiberAverageRows : 1;
}

}  // namespace

std::vector<gpu::FiberAverage> makeFiberAverages(const ShadingSettings& shading) {
    const Fiber fiber = makeFiber(shading);
    const OwnPowers powers = ownPowers(shading);
    const std::uint32_t rows = averageRows(powers);
    std::vector<gpu::FiberAverage> table(std::size_t{rows} * gpu::kFiberAverages);
    for (std::uint32_t i = 0; i < gpu::kFiberAverages; ++i) {
        const double cos_theta = static_cast<double>(i) / (gpu::kFiberAverages - 1);
        const std::vector<FiberSlice> slices = slicesOf(fiber, std::acos(cos_theta));
        for (std::uint32_t row = 0; row < rows; ++row) {
            const double power =
                rows == 1 ? 1.0
                          : powers.least + (powers.greatest - powers.least) * row / (rows - 1);
            const AbsorptionShare own{square(power) * fiber.absorption, 1};
            FiberAverages around = averageOverSlices(
                fiber, slices,
                strandsAround(fiber.absorption, power, double{shading.strand_variation}));
            around.forward *= double{shading.density_factor};
            around.backward *= double{shading.density_factor};
            const LocalScattering local = localScattering(around);
            table[std::size_t{row} * gpu::kFiberAverages + i] = {
                .forward = glm::dvec4(around.forward, around.forward_variance),
                .local = glm::dvec4(local.albedo, local.variance),
                .shifts = glm::dvec2(around.forward_shift, local.shift),
                .own = double{shading.density_factor} *
                       averageOverSlices(fiber, slices, {&own, 1}).forward};
        }
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
        .azimuthal_scale = s,
        .tilt_variance = square(glm::radians(static_cast<double>(shading.orientation_spread)))};
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
    const FiberWay way = fiberWay(fiber, theta_o, h);
    return {
        .attenuations = lobeAttenuations(way.fresnel, glm::exp(-fiber.absorption * way.length)),
        .azimuths = way.azimuths};
}

// ---- Many fibres --------------------------------------------------------------------------------

FiberAverages averageOverFiber(const Fiber& fiber, double theta) {
    const AbsorptionShare own{fiber.absorption, 1};
    return averageOverSlices(fiber, slicesOf(fiber, theta), {&own, 1});
}

// A fibre meets cos theta of the light from an angle theta, and a ring of directions at theta is
// proportional to cos theta.
glm::dvec3 surfaceTransmittance(const ShadingSettings& shading) {
    if (shading.model != ShadingModel::dual_scattering)
        return glm::dvec3(1 - double{shading.shadows.stopped});
    constexpr int kAngles = 32;
    const Fiber fiber = makeFiber(shading);
    const double power = 1 - double{shading.tip_lightening} / 2;
    const std::vector<AbsorptionShare> strands =
        strandsAround(fiber.absorption, power, double{shading.strand_variation});
    glm::dvec3 passed(0);
    double met = 0;
    for (int i = 0; i < kAngles; ++i) {
        const double theta = (i + 0.5) / kAngles * kPi / 2;
        const double weight = square(std::cos(theta));
        passed += weight * averageOverSlices(fiber, slicesOf(fiber, theta), strands).forward;
        met += weight;
    }
    return double{shading.density_factor} * passed / met;
}

OwnPowers ownPowers(const ShadingSettings& shading) {
    const double variation{shading.strand_variation};
    return {
        .least = (1 - variation) * (1 - double{shading.tip_lightening}), .greatest = 1 + variation};
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
    // If nothing comes back, the variance is that of one scattering, because shaders divide by it.
    local.variance = means.weight > 0 ? means.meanVariance() : averages.backward_variance;
    return local;
}

// ---- Buffers of shaders -------------------------------------------------------------------------

// Scalar layout aligns 64-bit members to 8, as C++ does.
static_assert(offsetof(gpu::HairOptics, averages) == 104 && sizeof(gpu::HairOptics) == 112);
static_assert(sizeof(gpu::FiberAverage) == 52);

engine::MemoryRows HairOpticsBuffers::rows(const ShadingSettings& shading) {
    engine::MemoryRows rows("shading", {{"hair optics", sizeof(gpu::HairOptics)}});
    if (shading.model == ShadingModel::dual_scattering)
        rows.add(
            "shading",
            {{"fiber averages", engine::bytesOf<gpu::FiberAverage>(
                                    averageRows(ownPowers(shading)) * gpu::kFiberAverages)}});
    return rows;
}

HairOpticsBuffers::HairOpticsBuffers(const engine::Device& device, const Settings& settings) {
    const engine::MemoryRows rows = HairOpticsBuffers::rows(settings.shading);
    gpu::HairOptics optics = makeHairOptics(settings.shading);
    if (settings.shading.model == ShadingModel::dual_scattering) {
        const std::vector<gpu::FiberAverage> table = makeFiberAverages(settings.shading);
        averages_ = engine::makeBuffer(device, table, rows, "fiber averages");
        optics.averages = averages_.address();
    }
    optics_ = engine::makeBuffer(device, std::array{optics}, rows, "hair optics");
}

}  // namespace hair::rendering
