#include "benchmarks/lod/walk.h"

#include <array>
#include <cmath>
#include <filesystem>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "benchmarks/reference/picture_errors.h"
#include "engine/float_pictures.h"
#include "tests/cli/reference_python.h"
#include "tests/temporary_folder.h"

namespace benchmarks {
namespace {

using testing::ElementsAre;

// Seen from a direction perpendicular to "up", the angle between light and camera is as requested.
TEST(LodTruth, LightGoesRoundTheHair) {
    hair::Settings settings;
    settings.camera.position = {3.0f, 1.0f, -4.0f};
    settings.camera.target = {0.0f, 1.0f, 0.0f};
    const glm::vec3 to_camera(0.6f, 0.0f, -0.8f);
    for (const double angle : lod::kLightAngles) {
        const hair::Settings lit = lod::litFrom(settings, angle);
        ASSERT_EQ(lit.shading.lights.size(), 1u);
        EXPECT_EQ(lit.shading.lights[0].type, hair::LightType::directional);
        const glm::vec3 to_light = -lit.shading.lights[0].direction;
        EXPECT_NEAR(glm::dot(to_light, to_camera), std::cos(glm::radians(angle)), 1e-6) << angle;
        EXPECT_NEAR(to_light.y, 0.0f, 1e-6f);
        EXPECT_EQ(lit.render.background, glm::vec3(0.0f));
        EXPECT_EQ(lit.render.tone_map, hair::ToneMap::srgb);
    }
}

TEST(LodTruth, LevelsReachTheGreatest) {
    EXPECT_THAT(lod::comparedLevels({.maximum_level = 4.0f}), ElementsAre(0, 1, 2, 3, 4));
    EXPECT_THAT(lod::comparedLevels({.maximum_level = 1.5f}), ElementsAre(0, 1, 2));
    EXPECT_THAT(lod::comparedLevels({.maximum_level = 0.0f}), ElementsAre(0));
}

TEST(LodTruth, LeavesOutWhatIsNotKnown) {
    const scene::Json json = lod::truthJson(
        {.samples = 8,
         .levels = {
             {.level = 0.0, .strands = 10, .lights = {{.angle = 90.0, .flip = 0.25, .rmse = 0.5}}},
             {.level = 1.0, .strands = 5, .popping = 0.125}}});
    EXPECT_EQ(json.at("samples"), 8);
    EXPECT_FALSE(json.at("levels").at(0).contains("popping"));
    EXPECT_FALSE(json.at("levels").at(0).at("lights").at(0).contains("light_ratio"));
    EXPECT_EQ(json.at("levels").at(0).at("lights").at(0).at("flip"), 0.25);
    EXPECT_EQ(json.at("levels").at(1).at("popping"), 0.125);
    EXPECT_TRUE(json.at("levels").at(1).at("lights").empty());
}

// Compares light before clipping: radiance 6 is 1.5 times radiance 4, although a display shows both
// alike.
TEST(LodTruth, LightRatioIsThatOfLinearLight) {
    if (!hasReferencePython()) GTEST_SKIP() << kNoReference;
    const TemporaryFolder folder;
    const auto write = [&](const char* name, float light) {
        const std::vector<float> picture(std::size_t{3} * 16 * 12, light);
        engine::writeExr(folder.file(name), 16, 12, picture);
        return folder.file(name);
    };
    const auto four = write("four.exr", 4.0f);
    const auto six = write("six.exr", 6.0f);
    const auto black = write("black.exr", 0.0f);
    const reference::PictureErrors errors = reference::comparePictures(four, six, {});
    ASSERT_TRUE(errors.light_ratio);
    EXPECT_NEAR(*errors.light_ratio, 1.5, 1e-6);
    EXPECT_EQ(errors.rmse, 0.0);
    EXPECT_FALSE(reference::comparePictures(black, six, {}).light_ratio);
}

}  // namespace
}  // namespace benchmarks
