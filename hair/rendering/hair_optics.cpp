#include "hair/rendering/hair_optics.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include "engine/transfer.h"
#include "hair/rendering/reference_dual_scattering.h"

namespace hair {

// Scalar layout aligns 64-bit members to 8, as C++ does.
static_assert(offsetof(gpu::HairOptics, averages) == 80 && sizeof(gpu::HairOptics) == 88);
static_assert(sizeof(gpu::FiberAverage) == 40 && sizeof(gpu::FiberProbe) == 56);

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

}  // namespace hair
