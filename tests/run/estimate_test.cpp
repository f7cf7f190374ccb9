// Tests how --dry-run estimates cases that it does not try.
#include "benchmarks/run/plan.h"

#include <gtest/gtest.h>

namespace benchmarks::run {
namespace {

// The thesis's 86 guides of 8 vertices have 136 root triangles (section 4.1): 136 x 64 strands of
// 7 x 4 segments. Its picture has 1280 x 720 pixels.
TEST(Estimate, CountsTheWorkOfTheThesisFrame) {
    hair::Settings settings;
    settings.groom.guides = 86;
    settings.groom.grow.vertices = 8;
    settings.strands.density = 64;
    settings.strands.tessellation = 4;
    settings.lod.mode = hair::LodMode::forced;
    settings.render.width = 1280;
    settings.render.height = 720;
    settings.render.msaa = 4;
    settings.render.ssaa = 1;
    const FrameWork work = frameWork(settings);
    EXPECT_EQ(work.segments, 136.0 * 64 * 7 * 4);
    EXPECT_EQ(work.samples, 1280.0 * 720 * 4);
    settings.render.hair = false;
    EXPECT_EQ(frameWork(settings).segments, 0.0);
}

TEST(Estimate, CountsStrandsAgainForEachLightThatTheyShade) {
    hair::Settings settings;
    settings.shading.lights.assign(3, hair::LightSettings{});
    settings.shading.lights[2].shadows = false;
    const FrameWork unshaded = frameWork(settings);
    settings.shading.shadows.hair = hair::HairShadows::deep_opacity;
    settings.shading.shadows.resolution = 512;
    const FrameWork shaded = frameWork(settings);
    EXPECT_EQ(shaded.segments, 3.0 * unshaded.segments);  // the camera's and two lights'
    EXPECT_EQ(shaded.samples, unshaded.samples + 2.0 * 512 * 512);
}

// If costs c >= 0 and parts w of the work give a time c . w, the time grows at most as much as the
// part that grows most. This bounds it for any costs.
TEST(Estimate, BoundsTimesThatAreSumsOfTheParts) {
    const FrameWork tried{.updates = 100.0, .segments = 1000.0, .samples = 5000.0};
    const FrameWork large{.updates = 700.0, .segments = 20'000.0, .samples = 5000.0};
    EXPECT_EQ(mostTimesLonger(large, tried), 20.0);
    for (const FrameWork& costs :
         {FrameWork{1.0, 0.0, 0.0}, FrameWork{0.0, 2.0, 0.0}, FrameWork{0.0, 0.0, 3.0},
          FrameWork{5.0, 1.0, 0.1}}) {
        const auto time = [&](const FrameWork& work) {
            return costs.updates * work.updates + costs.segments * work.segments +
                   costs.samples * work.samples;
        };
        EXPECT_LE(time(large), mostTimesLonger(large, tried) * time(tried));
    }
    EXPECT_EQ(mostTimesLonger(tried, {}), 5000.0);  // a missing part counts as one
}

// A smaller case is of the same kind, so it tells something about the larger one.
TEST(Estimate, KeepsBackEndsShadingModelsAndSolversApart) {
    hair::Settings settings;
    settings.groom.guides = 100'000;
    const CaseKind kind = kindOf(settings);
    EXPECT_EQ(kindOf(smaller(settings)), kind);
    hair::Settings other = settings;
    other.strands.backend = hair::Backend::software;
    EXPECT_NE(kindOf(other), kind);
    other = settings;
    other.shading.model = hair::ShadingModel::dual_scattering;
    EXPECT_NE(kindOf(other), kind);
    other = settings;
    other.simulation.solver = hair::Solver::rod;
    EXPECT_NE(kindOf(other), kind);
}

TEST(Estimate, MakesLargeCasesSmall) {
    hair::Settings large;
    large.groom.guides = 100'000;
    large.groom.grow.strands = 100'000;
    large.strands.density = 64;
    large.simulation.settle_steps = 10'000;
    large.simulation.distance_fields.emplace_back();
    large.simulation.pulls = {{.guide = 99'999}};
    large.render.width = 1920;
    large.render.height = 1080;
    large.render.ssaa = 4;
    large.shading.shadows.hair = hair::HairShadows::deep_shadow;
    EXPECT_FALSE(isSmall(large, 1.0));
    const hair::Settings small = smaller(large);
    EXPECT_TRUE(isSmall(small, 1.0));
    // The aspect ratio is kept, to a pixel.
    EXPECT_NEAR(small.render.width * 9.0, small.render.height * 16.0, 16.0);
    EXPECT_EQ(small.render.ssaa, 4u);
    EXPECT_LT(small.simulation.pulls[0].guide, small.groom.guides);
    EXPECT_EQ(small.strands.tessellation, large.strands.tessellation);
}

}  // namespace
}  // namespace benchmarks::run
