// Tests pictures under many lights, and of wet hair.
#include <cmath>

#include <gtest/gtest.h>

#include "engine/target.h"
#include "hair/rendering/render_assets.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/rendering/linear_picture.h"

namespace hair::rendering {
namespace {

class LightPictures : public GpuTest {};

// Sixteen lights of every type, all round.
std::vector<LightSettings> manyLights() {
    std::vector<LightSettings> lights;
    for (std::uint32_t i = 0; i < 16; ++i) {
        const float angle = 0.4f * static_cast<float>(i);
        const glm::vec3 position(2.0f * std::cos(angle), 0.5f, 2.0f * std::sin(angle));
        lights.push_back(
            {.type = static_cast<LightType>(i % 4),
             .position = position,
             .direction = -0.3f * position,
             .color = {0.3f, 0.5f, 0.2f + 0.02f * static_cast<float>(i)},
             .reference_distance = i % 8 < 4 ? 1.5f : 0.0f});
    }
    return lights;
}

TEST_F(LightPictures, OfManyLightsAreTheSumOfEachAlone) {
    Settings settings = linearPicture(32, 32);
    settings.shading.lights = manyLights();
    const groom::Groom groom = tangledGroom(4);
    const std::vector<float> together = drawLinear(device(), settings, groom);
    std::vector<double> sum(together.size());
    for (const LightSettings& light : manyLights()) {
        settings.shading.lights = {light};
        const std::vector<float> alone = drawLinear(device(), settings, groom);
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += double{alone[i]};
    }
    ASSERT_EQ(together.size(), sum.size());
    Extremes sums;
    for (std::size_t i = 0; i < sum.size(); ++i) {
        // Half floats round each of the seventeen contributions by up to 2^-11, after single
        // precision.
        ASSERT_NEAR(together[i], sum[i], 0x1p-10 * sum[i] + 1e-6) << i;
        sums.add(sum[i]);
    }
    EXPECT_GT(sums.greatest(), 0.5);  // it is lit
}

// Water shows in the picture as the settings of wet hair do. It makes hair darker outside
// highlights, which models with fibres have everywhere under lights all round.
TEST_F(LightPictures, OfWetHairAreThoseOfItsSettings) {
    const groom::Groom groom = tangledGroom(4);
    for (const ShadingModel model :
         {ShadingModel::phong, ShadingModel::kajiya_kay, ShadingModel::marschner,
          ShadingModel::dual_scattering}) {
        Settings settings = linearPicture(32, 32);
        settings.shading.lights = manyLights();
        settings.shading.model = model;
        settings.shading.specular = 0.0f;
        const std::vector<float> dry = drawLinear(device(), settings, groom);
        settings.simulation.material.water = 0.5f;
        const std::vector<float> wet = drawLinear(device(), settings, groom);
        Settings replaced = wetted(settings);
        replaced.simulation.material.water = 0.0f;
        EXPECT_EQ(wet, drawLinear(device(), replaced, groom)) << static_cast<int>(model);
        EXPECT_NE(wet, dry) << static_cast<int>(model);
        if (model == ShadingModel::marschner || model == ShadingModel::dual_scattering) continue;
        double light = 0.0;
        double less = 0.0;
        for (std::size_t i = 0; i < dry.size(); ++i) {
            light += double{dry[i]};
            less += double{wet[i]};
        }
        EXPECT_LT(less, 0.95 * light) << static_cast<int>(model);
    }
}

}  // namespace
}  // namespace hair::rendering
