#include "benchmarks/lod/walk.h"

#include <filesystem>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "benchmarks/scene/scene.h"
#include "tests/gpu_fixture.h"

namespace benchmarks {
namespace {

TEST(LodPath, StepsAreOfOneRatio) {
    const auto distances = lod::distancesOf({.from = 0.5, .to = 8.0, .steps = 5});
    ASSERT_EQ(distances.size(), 5u);
    for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(distances[i], 0.5 * (1u << i), 1e-12);
}

TEST(LodPath, CameraKeepsItsDirection) {
    hair::CameraSettings camera;
    camera.position = {1.0f, 2.0f, 3.0f};
    camera.target = {1.0f, 0.0f, 3.0f};
    const hair::CameraSettings moved = lod::cameraAt(camera, 7.0);
    EXPECT_EQ(moved.position, glm::vec3(1.0f, 7.0f, 3.0f));
    EXPECT_EQ(moved.target, camera.target);
}

TEST(Turn, MovesTheCameraOnACircleAboutItsUpVector) {
    hair::CameraSettings camera;
    camera.position = {0.0f, 1.0f, 2.0f};
    camera.target = {0.0f, 1.0f, 0.0f};
    camera.up = {0.0f, 3.0f, 0.0f};
    const hair::CameraSettings turned = lod::cameraTurned(camera, 90.0);
    EXPECT_NEAR(turned.position.x, 2.0f, 1e-6f);
    EXPECT_NEAR(turned.position.y, 1.0f, 1e-6f);
    EXPECT_NEAR(turned.position.z, 0.0f, 1e-6f);
    EXPECT_EQ(turned.target, camera.target);
}

TEST(Turn, TruthHas64SamplesAndNeedsNoTransparencyForOpaqueHair) {
    hair::Settings settings;
    settings.render.coverage = hair::Coverage::analytic;
    settings.render.transparency = hair::Transparency::fragment_list;
    const hair::RenderSettings opaque = lod::supersampled(settings).render;
    EXPECT_EQ(opaque.msaa * opaque.ssaa * opaque.ssaa, 64u);
    EXPECT_EQ(opaque.coverage, hair::Coverage::sampled);
    EXPECT_EQ(opaque.transparency, hair::Transparency::none);
    settings.strands.opacity = 0.5f;
    EXPECT_EQ(lod::supersampled(settings).render.transparency, hair::Transparency::fragment_list);
}

class LodWalkTest : public GpuTest {};

// Samples at the same places of the pixels see other strands in each view. The mean of more samples
// differs less from the truth, so that its error and its shimmer are smaller.
TEST_F(LodWalkTest, MoreSamplesShimmerLess) {
    hair::Settings settings;
    settings.simulation.solver = hair::Solver::none;
    settings.strands.density = 8;
    settings.render.width = 64;
    settings.render.height = 48;
    const measure::Case hair(device(), settings, HAIRBENCH_SOURCE_DIR "/scenes");
    const lod::TurnPath path{.degrees = 2.0, .steps = 2};
    lod::TurnTruth truth;
    std::vector<double> begun;
    const auto begin = [&](double degrees) { begun.push_back(degrees); };
    const auto figures = [&](std::uint32_t ssaa) {
        settings.render.ssaa = ssaa;
        return lod::shimmerOf(
            device(), hair, settings, path, truth.pictures(device(), hair, settings, path, begin),
            begin);
    };
    const lod::Shimmer one = figures(1);
    EXPECT_EQ(begun, (std::vector{0.0, 1.0, 2.0, 0.0, 1.0, 2.0}));
    const lod::Shimmer four = figures(2);
    EXPECT_EQ(begun.size(), 9u) << "the truth is drawn once for both";
    EXPECT_GT(one.change, 0.0);
    EXPECT_EQ(four.change, one.change);
    EXPECT_GT(four.error, 0.0);
    EXPECT_GT(one.error, four.error);
    EXPECT_GT(four.shimmer, 0.0);
    EXPECT_GT(one.shimmer, four.shimmer);

    settings = lod::supersampled(settings);
    const lod::Shimmer full = figures(4);
    EXPECT_EQ(full.shimmer, 0.0);
    EXPECT_EQ(full.error, 0.0);
}

TEST_F(LodWalkTest, ComparesWithFullDetail) {
    hair::Settings settings;
    settings.simulation.solver = hair::Solver::none;
    settings.strands.density = 16;
    settings.camera.field_of_view = 20.0f;
    settings.render.width = 96;
    settings.render.height = 64;
    settings.lod.near_distance = 1.0f;
    settings.lod.error = 4.0f;
    measure::Case hair(device(), settings, HAIRBENCH_SOURCE_DIR "/scenes");
    std::vector<lod::LodStep> steps;
    std::vector<double> begun;
    lod::walk(
        device(), hair, settings, {.from = 0.5, .to = 4.0, .steps = 2}, lod::LodKind::cluster,
        [&](double distance) { begun.push_back(distance); }, steps);
    ASSERT_EQ(steps.size(), 2u);
    EXPECT_EQ(begun, (std::vector{0.5, 4.0}));

    // Everything within 1 m is level 0, so both pictures are equal.
    EXPECT_EQ(steps[0].drawn.mean_level, 0.0);
    EXPECT_EQ(steps[0].drawn.error, 0.0);
    EXPECT_EQ(steps[0].drawn.flip, 0.0);
    EXPECT_EQ(steps[0].drawn.coverage, steps[0].full_coverage);
    EXPECT_EQ(steps[0].drawn.strands, steps[0].full_strands);
    EXPECT_FALSE(steps[0].drawn.popping);

    // At 4 m, level 4 log(4) / log(8) = 2.67; roots are up to about 0.1 m nearer or farther.
    EXPECT_NEAR(steps[1].drawn.mean_level, 2.67, 0.1);
    EXPECT_GT(steps[1].drawn.error, 0.0);
    // The picture before has no error, so all of the error at 4 m is popping.
    ASSERT_TRUE(steps[1].drawn.popping);
    EXPECT_DOUBLE_EQ(*steps[1].drawn.popping, steps[1].drawn.error);
    EXPECT_LT(*steps[1].drawn.strands, steps[1].full_strands);
    EXPECT_GT(steps[1].full_coverage, 0.05);
    EXPECT_GT(steps[1].full_time.frame, steps[1].full_time.strands);

    // The head is some 80 px high at 0.5 m, and 10 at 4 m, where 4 px leave few strands.
    ASSERT_TRUE(steps[0].clusters && steps[1].clusters);
    EXPECT_EQ(steps[0].clusters->strands, steps[0].full_strands);
    EXPECT_LT(steps[0].clusters->error, steps[1].clusters->error);
    EXPECT_LT(*steps[1].clusters->strands, steps[1].full_strands / 2);
    EXPECT_GT(steps[1].clusters->mean_level, 1.0);
    EXPECT_GT(steps[1].clusters->flip, 0.0);
    // Levels are those of the picture, not of the one that measures coverage, so it changes.
    EXPECT_NE(steps[1].clusters->coverage, steps[1].full_coverage);
}

// The scene of Huang et al. 2025, with a sixteenth of its strands in a small picture. Their hair
// has 1050 K segments, of which they draw 418 K in their far view. docs/rendering.md has both in
// full.
TEST_F(LodWalkTest, DrawsThePapersHairWithFewerSegmentsFromAfar) {
    const std::filesystem::path path =
        std::filesystem::path(HAIRBENCH_SOURCE_DIR) / "scenes/papers/level_of_detail.json";
    hair::Settings settings = scene::loadScene(path).settings;
    ASSERT_EQ(settings.lod.mode, hair::LodMode::cluster);
    constexpr std::uint32_t kPart = 16;
    ASSERT_EQ(settings.strands.density % kPart, 0u);
    settings.strands.density /= kPart;
    settings.simulation.settle_steps = 60;
    constexpr std::uint32_t kWidth = 160;
    settings.lod.error *= static_cast<float>(kWidth) / static_cast<float>(settings.render.width);
    settings.render.width = kWidth;
    settings.render.height = 90;
    measure::Case hair(device(), settings, path.parent_path());
    std::vector<lod::LodStep> steps;
    lod::walk(
        device(), hair, settings, {.from = 0.5, .to = 16.0, .steps = 3}, lod::LodKind::cluster,
        [](double) {}, steps);
    ASSERT_EQ(steps.size(), 3u);
    double before = 2.0;
    for (const lod::LodStep& step : steps) {
        EXPECT_NEAR(static_cast<double>(step.full_segments * kPart), 1.05e6, 0.002 * 1.05e6);
        ASSERT_TRUE(step.clusters && step.clusters->segments);
        const double share =
            static_cast<double>(*step.clusters->segments) / static_cast<double>(step.full_segments);
        EXPECT_LE(share, before) << step.distance;
        before = share;
        // No strand has fewer than a segment for each of its guide's.
        EXPECT_GE(
            share, static_cast<double>(*step.clusters->strands) /
                       static_cast<double>(step.full_strands) / settings.strands.tessellation);
    }
    EXPECT_EQ(steps[0].clusters->segments, steps[0].full_segments);
    EXPECT_LT(steps[0].clusters->flip, 1e-4);
    EXPECT_LT(before, 418.0 / 1050.0);
}

}  // namespace
}  // namespace benchmarks
