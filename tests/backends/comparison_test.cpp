#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "benchmarks/measure/measure.h"
#include "benchmarks/run/backends.h"
#include "benchmarks/scene/scene.h"
#include "tests/error_text.h"
#include "tests/gpu_fixture.h"

namespace benchmarks::run {
namespace {

using report::Measured;

TEST(CoveredBy, CountsSharesOfPixels) {
    std::vector<std::uint8_t> white(4 * 4, 0);
    std::vector<std::uint8_t> black(4 * 4, 0);
    white[0] = 255;  // all of the first pixel's four samples
    black[4] = 64;  // the part without hair, a quarter of 255, is in both
    white[4] = 64 + 191;  // hair covers three quarters: three samples
    white[8] = black[8] = 200;  // no sample
    white[12] = 64;  // one sample
    const Covered covered = coveredBy(white, black, 4);
    EXPECT_EQ(covered.samples, 4u + 3u + 1u);
    EXPECT_EQ(covered.pixels, 3u);
    EXPECT_NE(errorText([&] { coveredBy(white, {}, 4); }), "no error");
}

class BackendComparisonTest : public GpuTest {
protected:
    // Returns a small close-up of the thesis's hair in the wind.
    static hair::Settings smallCase(hair::Backend backend, std::uint32_t samples) {
        hair::Settings settings = scene::loadScene(HAIRBENCH_SCENES_DIR "/thesis.json").settings;
        settings.simulation.settle_steps = 20;
        settings.simulation.wind.strength = 10.0f;
        settings.strands.backend = backend;
        settings.strands.density = 4;
        settings.camera.position = {0.2f, 0.06f, 0.36f};
        settings.camera.field_of_view = 45.0f;
        settings.render.width = 160;
        settings.render.height = 90;
        settings.render.msaa = samples;
        settings.run = {.warmup = 2, .frames = 5, .max_time = 0.0f, .compare_backends = true};
        return settings;
    }

    report::CaseResult compared(const hair::Settings& settings) {
        measure::Case test_case(device(), settings, HAIRBENCH_SCENES_DIR);
        report::CaseResult result;
        const measure::MeasureHooks hooks{.stop = [] { return false; }};
        const auto picture = measure::measure(device(), test_case, settings.run, hooks, result);
        comparison_.add(device(), test_case, settings, picture, result);
        return result;
    }

    static double only(const report::CaseResult& result, const report::MetricId& id) {
        const report::Metric* const metric = report::findMetric(result.metrics, id);
        EXPECT_TRUE(metric && metric->samples.size() == 1) << id.name();
        return metric && !metric->samples.empty() ? metric->samples[0] : std::nan("");
    }

    static std::uint64_t count(const report::CaseResult& result, const std::string& name) {
        for (const auto& [each, value] : result.counts)
            if (each == name) return value;
        ADD_FAILURE() << name;
        return 0;
    }

    BackendComparison comparison_;  // for all cases of a run
};

// For the bounds with one sample a pixel see tests/rendering/points_picture_test.cpp.
TEST_F(BackendComparisonTest, HasErrorsToTessellation) {
    const auto error = [&](hair::Backend backend) {
        const auto result = compared(smallCase(backend, 1));
        for (const std::string& warning : result.trust.warnings)
            EXPECT_THAT(warning, testing::Not(testing::HasSubstr("compare_backends")));
        return only(result, report::ofImage(Measured::flip_tessellation));
    };
    // Drawing the same state again gives the same picture.
    EXPECT_EQ(error(hair::Backend::tessellation), 0.0);
    const double expanded = error(hair::Backend::expanded);
    EXPECT_GT(expanded, 0.0);
    EXPECT_LE(expanded, 0.005);
    const double software = error(hair::Backend::software);
    EXPECT_GT(software, 0.0);
    EXPECT_LE(software, 0.02);
    // Lines draw the strands only roughly.
    EXPECT_GT(error(hair::Backend::lines), 2.0 * software);
}

TEST_F(BackendComparisonTest, HasTimesAndLimits) {
    const auto tessellation = compared(smallCase(hair::Backend::tessellation, 4));
    const auto software = compared(smallCase(hair::Backend::software, 4));
    for (const auto& result : {tessellation, software})
        for (const std::string& warning : result.trust.warnings)
            EXPECT_THAT(warning, testing::Not(testing::HasSubstr("compare_backends")));
    // A picture with several separately shaded samples is nearer to one with many.
    const auto to_many = report::ofImage(Measured::flip_many_samples);
    EXPECT_LT(only(software, to_many), only(tessellation, to_many));
    EXPECT_GT(only(software, to_many), 0.0);
    EXPECT_LT(only(tessellation, to_many), 0.2);

    for (const auto& result : {tessellation, software}) {
        // 7 segments of 4 pieces have 29 points.
        EXPECT_EQ(count(result, "points"), count(result, "strands") * 29);
        const double pixels = static_cast<double>(count(result, "covered_pixels"));
        const double samples = static_cast<double>(count(result, "covered_samples"));
        EXPECT_GT(pixels, 1000.0);
        EXPECT_LE(samples, 4.0 * pixels);
        EXPECT_GE(samples, pixels);
        const auto* const time =
            report::findMetric(result.metrics, report::ofStrands(Measured::time));
        const auto* const per_point =
            report::findMetric(result.metrics, report::ofStrands(Measured::time_per_point));
        const auto* const share =
            report::findMetric(result.metrics, report::ofStrands(Measured::limit_share));
        ASSERT_TRUE(time && per_point && share);
        ASSERT_EQ(time->samples.size(), 5u);
        const double limit = only(result, report::ofStrands(Measured::limit));
        for (std::size_t i = 0; i < time->samples.size(); ++i) {
            EXPECT_NEAR(
                per_point->samples[i] * static_cast<double>(count(result, "points")) * 1e-6,
                time->samples[i], 1e-9);
            EXPECT_NEAR(share->samples[i] * time->samples[i], limit, 1e-9);
        }
    }
    // The quads of both back ends cover the same samples, except for rounding.
    EXPECT_NEAR(
        static_cast<double>(count(software, "covered_samples")) /
            static_cast<double>(count(tessellation, "covered_samples")),
        1.0, 0.01);
    // The software back end evaluates points in another pass.
    const auto* const points =
        report::findMetric(software.metrics, report::ofPass("points", Measured::time));
    const auto* const strands =
        report::findMetric(software.metrics, report::ofPass("strands", Measured::time));
    const auto* const sum = report::findMetric(software.metrics, report::ofStrands(Measured::time));
    ASSERT_TRUE(points && strands && sum);
    for (std::size_t i = 0; i < sum->samples.size(); ++i)
        EXPECT_DOUBLE_EQ(sum->samples[i], points->samples[i] + strands->samples[i]);
}

// Counts the pixels that differ from a picture without hair, whatever the hair's colour and light.
TEST_F(BackendComparisonTest, CountsPixelsThatShowHair) {
    hair::Settings settings = smallCase(hair::Backend::tessellation, 1);
    settings.shading.model = hair::ShadingModel::marschner;
    settings.render.tone_map = hair::ToneMap::srgb;
    const auto result = compared(settings);
    measure::Case test_case(device(), settings, HAIRBENCH_SCENES_DIR);
    hair::Settings bald = settings;
    bald.render.hair = false;
    const auto drawn = [&](const hair::Settings& with) {
        measure::Case each(device(), with, HAIRBENCH_SCENES_DIR);
        engine::FrameLoop loop(device(), engine::Timing::isolated);
        for (int i = 0; i < 8; ++i) loop.frame([&](engine::Passes& passes) { each.frame(passes); });
        loop.finish();
        return each.picture();
    };
    const auto with = drawn(settings);
    const auto without = drawn(bald);
    ASSERT_EQ(with.size(), without.size());
    std::uint64_t differ = 0;
    for (std::size_t i = 0; i < with.size(); i += 4)
        differ += !std::equal(&with[i], &with[i] + 3, &without[i]);
    EXPECT_EQ(count(result, "covered_samples"), count(result, "covered_pixels"));
    // In some pixels hair may look like the surface that it hides.
    EXPECT_GE(count(result, "covered_pixels"), differ);
    EXPECT_LE(
        static_cast<double>(count(result, "covered_pixels")), 1.02 * static_cast<double>(differ));
}

TEST_F(BackendComparisonTest, SaysWhatItCannotHave) {
    hair::Settings bald = smallCase(hair::Backend::tessellation, 1);
    bald.render.hair = false;
    EXPECT_THAT(
        compared(bald).trust.warnings,
        testing::Contains(testing::HasSubstr("compare_backends: no hair is drawn")));
    hair::Settings levels = smallCase(hair::Backend::tessellation, 1);
    levels.lod.mode = hair::LodMode::distance;
    const auto result = compared(levels);
    EXPECT_THAT(
        result.trust.warnings, testing::Contains(testing::HasSubstr("how many points are drawn")));
    EXPECT_EQ(only(result, report::ofImage(Measured::flip_tessellation)), 0.0);
    EXPECT_EQ(
        report::findMetric(result.metrics, report::ofStrands(Measured::time_per_point)), nullptr);
}

}  // namespace
}  // namespace benchmarks::run
