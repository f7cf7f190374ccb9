#include "benchmarks/measure/trust.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/decide/noise.h"
#include "tests/decide/scipy_values.h"
#include "tests/error_text.h"

namespace benchmarks::report {
namespace {

TEST(Trend, IsScipys) {
    for (const auto& row : scipyValues()["trend"]) {
        const auto values = row["values"].get<std::vector<double>>();
        const measure::Trend found = measure::trend(values);
        EXPECT_EQ(found.score, row["score"].get<double>()) << values.size();
        EXPECT_NEAR(found.p, row["p"], 1e-12) << values.size();
        EXPECT_NEAR(measure::medianSlope(values), row["slope"], 1e-12) << values.size();
    }
}

// Times of a clock with few steps, pair by pair.
TEST(Trend, CountsEveryPair) {
    Noise noise(11);
    for (const std::size_t n : {2u, 3u, 64u, 257u, 1000u}) {
        std::vector<double> values;
        for (std::size_t i = 0; i < n; ++i) values.push_back(std::round(5.0 * noise.normal()));
        double score = 0.0;
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = i + 1; j < n; ++j)
                score += (values[j] > values[i]) - (values[j] < values[i]);
        EXPECT_EQ(measure::trend(values).score, score) << n;
    }
}

TEST(Trend, OfNothingIsNone) {
    EXPECT_EQ(measure::trend({}).p, 1.0);
    EXPECT_EQ(measure::trend(std::vector{1.0}).p, 1.0);
    EXPECT_EQ(measure::trend(std::vector(32, 1.0)).p, 1.0);
    EXPECT_DOUBLE_EQ(
        measure::trend(std::vector{1.0, 2.0, 3.0}).p, 2.0 / 6.0);  // one of six orders, and two
                                                                   // sides
    EXPECT_EQ(
        errorText([] { measure::medianSlope(std::vector{1.0}); }),
        "median slope: fewer than two samples");
}

// With white noise of 10 % no tolerance helps: the exact test's level bounds the error rate.
TEST(SteadyState, OfWhiteNoiseIsSeen) {
    Noise noise(7);
    constexpr int kWindows = 5000;
    int drifts = 0;
    for (int i = 0; i < kWindows; ++i) {
        std::vector<double> window(32);
        for (double& value : window) value = 10.0 * (1.0 + 0.1 * noise.normal());
        drifts += !measure::isSteady(window);
    }
    EXPECT_LE(drifts, mostOf(kWindows, measure::SteadyRule{}.level));
}

TEST(SteadyState, IsNotSeenInAWarmUp) {
    // Caches warm up: times start 5 % higher and approach the final value by a factor of e every 10
    // frames; noise is 0.5 %.
    Noise noise(8);
    int found_early = 0;
    int found_late = 0;
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<double> frames;
        for (int i = 0; i < 120; ++i)
            frames.push_back(10.0 * (1.0 + 0.05 * std::exp(-i / 10.0) + 0.005 * noise.normal()));
        found_early += measure::isSteady(std::span(frames).first(32));
        found_late += measure::isSteady(frames);
    }
    EXPECT_EQ(found_early, 0);
    EXPECT_EQ(found_late, 200);  // the remaining drift is far below the tolerance
}

TEST(SteadyState, TakesASmallDriftForNone) {
    std::vector<double> frames;  // rises in every frame, by 0.5 % over the window
    for (int i = 0; i < 32; ++i) frames.push_back(10.0 + 0.05 * i / 31);
    EXPECT_TRUE(measure::isSteady(frames));
    for (double& frame : frames) frame = 10.0 + 3.0 * (frame - 10.0);
    EXPECT_FALSE(measure::isSteady(frames));
}

TEST(SteadyState, WantsAWholeWindowAndLooksAtTheLast) {
    EXPECT_FALSE(measure::isSteady({}));
    EXPECT_FALSE(measure::isSteady(std::vector(31, 1.0)));
    std::vector<double> frames;
    for (int i = 0; i < 40; ++i) frames.push_back(50.0 - i);
    frames.insert(frames.end(), 32, 10.0);
    EXPECT_TRUE(measure::isSteady(frames));
}

}  // namespace
}  // namespace benchmarks::report
