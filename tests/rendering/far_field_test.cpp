// Fibres thinner than a pixel, and pixels on wider ones, compared with means over the width.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "hair/reference/fiber.h"
#include "tests/gpu_fixture.h"
#include "tests/rendering/fiber_rig.h"
#include "tests/rendering/strand_probe.h"

namespace hair::rendering {
namespace {

using FarField = GpuTest;

constexpr double kProbeWidth = 1e-4;  // m, of the probes' strands

Settings farSettings(float roughness, const glm::dvec3& to_light) {
    Settings settings;
    settings.render.tone_map = ToneMap::srgb;
    settings.shading = brownFiber();
    settings.shading.model = ShadingModel::marschner;
    settings.shading.longitudinal_roughness = roughness;
    settings.shading.azimuthal_roughness = roughness;
    settings.shading.far_field = true;
    settings.shading.lights = {{.type = LightType::directional, .direction = -to_light}};
    return settings;
}

std::vector<gpu::StrandProbe> allRound(float across) {
    std::vector<gpu::StrandProbe> probes;
    for (const double sin_o : {-0.6, 0.0, 0.4})
        for (int i = 0; i < 48; ++i)
            probes.push_back(
                {.tangent = {1, 0, 0},
                 .to_eye = direction(sin_o, 2 * std::numbers::pi * i / 48),
                 .across = across,
                 .normal = {},
                 .color = {}});
    return probes;
}

// The mean over h in [from, to] of a fibre under irradiance pi.
glm::dvec3
meanOver(const Fiber& fiber, const glm::dvec3& wo, const glm::dvec3& wi, double from, double to) {
    constexpr int kSteps = 1000;
    glm::dvec3 sum(0);
    for (int i = 0; i < kSteps; ++i)
        sum += reference::scattering(fiber, wo, wi, from + (to - from) * (i + 0.5) / kSteps);
    return sum * std::numbers::pi / double{kSteps};
}

struct FarError {
    double largest = 0;  // over the greatest value
    double mean = 0;  // of the differences' sizes, over the mean
    double ratio = 0;  // of the sums
};

FarError errorOf(
    const engine::Device& device, float roughness, float across, double pixel, double from,
    double to) {
    const glm::dvec3 to_light = direction(0.3, 1.0);
    const Settings settings = farSettings(roughness, to_light);
    const Fiber fiber = makeFiber(settings.shading);
    double largest = 0, greatest = 0, off = 0, found = 0, expected = 0;
    for (const gpu::StrandProbe& probe :
         shadeStrands(device, settings, allRound(across), static_cast<float>(pixel))) {
        const glm::dvec3 mean = meanOver(fiber, probe.to_eye, to_light, from, to);
        for (int c = 0; c < 3; ++c) {
            const double apart = std::abs(double{probe.color[c]} - mean[c]);
            largest = std::isfinite(apart) ? std::max(largest, apart) : 1e30;
            greatest = std::max(greatest, mean[c]);
            off += apart;
            found += probe.color[c];
            expected += mean[c];
        }
    }
    return {largest / greatest, off / expected, found / expected};
}

// The shader uses eight parts of the width; in each it takes the middle's attenuation and a linear
// Phi(p). The error grows as lobes get narrower. Midpoints of 1000 steps are exact in comparison.
TEST_F(FarField, IsTheMeanOverTheWidthOfThinFibers) {
    struct Row {
        float roughness;
        double largest;
        double mean;
        double sum;
    };
    for (const Row& row :
         {Row{0.2f, 0.18, 0.08, 0.04}, Row{0.3f, 0.05, 0.04, 0.02}, Row{0.5f, 0.01, 0.015, 0.005},
          Row{0.9f, 0.005, 0.005, 0.002}})
        for (const float across : {-0.9f, 0.2f}) {  // for any position of the pixel's middle
            const FarError error =
                errorOf(device(), row.roughness, across, 10 * kProbeWidth, -1, 1);
            EXPECT_LT(error.largest, row.largest) << row.roughness;
            EXPECT_LT(error.mean, row.mean) << row.roughness;
            EXPECT_NEAR(error.ratio, 1.0, row.sum) << row.roughness;
        }
}

// from h - 0.4 to h + 0.4, or to the edge if that is nearer
TEST_F(FarField, IsTheMeanOverThePartThatAPixelSees) {
    for (const float roughness : {0.3f, 0.5f}) {
        const FarError middle = errorOf(device(), roughness, 0.2f, 0.4 * kProbeWidth, -0.2, 0.6);
        EXPECT_LT(middle.largest, 0.005) << roughness;
        const FarError edge = errorOf(device(), roughness, 0.8f, 0.5 * kProbeWidth, 0.3, 1.0);
        EXPECT_LT(edge.largest, 0.02) << roughness;
        EXPECT_LT(edge.mean, 0.02) << roughness;
    }
}

TEST_F(FarField, WideFibersShowThePlace) {
    const glm::dvec3 to_light = direction(0.3, 1.0);
    Settings settings = farSettings(0.3f, to_light);
    const auto wide = shadeStrands(device(), settings, allRound(0.4f), 0.05 * kProbeWidth);
    settings.shading.far_field = false;
    const auto place = shadeStrands(device(), settings, allRound(0.4f));
    for (std::size_t i = 0; i < wide.size(); ++i) EXPECT_EQ(wide[i].color, place[i].color) << i;
}

}  // namespace
}  // namespace hair::rendering
