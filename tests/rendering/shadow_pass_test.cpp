#include <gtest/gtest.h>

#include "engine/error.h"
#include "tests/gpu_fixture.h"
#include "tests/rendering/pictures.h"
#include "tests/rendering/shadow_probe.h"

namespace hair::rendering {
namespace {

using ShadowPassTest = GpuTest;

TEST(ShadowAtlas, PartsLieSideBySide) {
    const ShadowAtlas atlas{.parts = 5, .side = 64};
    EXPECT_EQ(atlas.extent().width, 192u);
    EXPECT_EQ(atlas.extent().height, 128u);
    EXPECT_EQ(atlas.part(4).offset.x, 64);
    EXPECT_EQ(atlas.part(4).offset.y, 64);
    EXPECT_EQ(atlas.part(4).extent.width, 64u);
}

TEST(EnclosingSphere, HoldsBoth) {
    const Sphere both = enclosing({{0, 0, 0}, 1.0f}, {{3, 0, 0}, 0.5f});
    EXPECT_FLOAT_EQ(both.centre.x, 1.25f);  // from -1 to 3.5
    EXPECT_FLOAT_EQ(both.radius, 2.25f);
    EXPECT_FLOAT_EQ(enclosing({{0, 0, 0}, 1.0f}, {{0.2f, 0, 0}, 0.5f}).radius, 1.0f);
    EXPECT_FLOAT_EQ(enclosing({{0, 0, 0}, 0.0f}, {{2, 0, 0}, 0.5f}).centre.x, 2.0f);
}

TEST_F(ShadowPassTest, AtlasesTheDeviceLacksAreUnsupported) {
    const std::uint32_t limit = device().info().limits.maxImageDimension2D;
    EXPECT_NO_THROW(checkAtlas(device(), {.parts = 4, .side = limit / 4}));
    EXPECT_THROW(checkAtlas(device(), {.parts = 2, .side = limit}), engine::Unsupported);
}

TEST_F(ShadowPassTest, ThereIsNothingWhereNoShadowsAreAskedFor) {
    Settings settings;
    settings.strands.backend = Backend::tessellation;
    const DeviceHair hair(device(), tangledGroom(4), settings);
    const StrandPlan plan = planStrands(hair.view(), settings, 64);
    const auto sides = [&] {
        const ShadowPass shadows(device(), settings, plan, {});
        std::vector<std::uint32_t> result;
        for (const engine::SampledImage& sampled : shadows.images())
            result.push_back(sampled.image->extent().width);
        return result;
    };
    using Sides = std::vector<std::uint32_t>;
    EXPECT_EQ(sides(), (Sides{1, 1, 1}));
    settings.shading.shadows.meshes = true;
    settings.shading.shadows.resolution = 64;
    EXPECT_EQ(sides(), (Sides{64, 1, 1}));
    settings.shading.shadows.hair = HairShadows::deep_opacity;
    EXPECT_EQ(sides(), (Sides{64, 64, 64}));
    settings.render.hair = false;
    EXPECT_EQ(sides(), (Sides{64, 1, 1}));
    settings.shading.lights[0].shadows = false;
    EXPECT_EQ(sides(), (Sides{1, 1, 1}));
}

TEST_F(ShadowPassTest, PictureIsTheSameWhereNoLightThrowsThem) {
    Settings settings = thesisAtRest();
    settings.render.width = 160;
    settings.render.height = 90;
    const Pixels plain = drawCase(device(), settings);
    settings.shading.shadows.meshes = true;
    settings.shading.shadows.hair = HairShadows::deep_opacity;
    settings.shading.lights[0].shadows = false;
    EXPECT_EQ(differingPixels(plain, drawCase(device(), settings)), 0u);
}

}  // namespace
}  // namespace hair::rendering
