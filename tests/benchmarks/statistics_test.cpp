#include "benchmarks/report/statistics.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/error_text.h"

namespace benchmarks {
namespace {

TEST(Summary, OfAnOddCount) {
    const report::Summary s = report::summarize(std::vector{9.0, 1.0, 4.0, 2.0, 3.0});
    EXPECT_EQ(s.count, 5u);
    EXPECT_DOUBLE_EQ(s.minimum, 1.0);
    EXPECT_DOUBLE_EQ(s.first_quartile, 2.0);
    EXPECT_DOUBLE_EQ(s.median, 3.0);
    EXPECT_DOUBLE_EQ(s.third_quartile, 4.0);
    EXPECT_DOUBLE_EQ(s.maximum, 9.0);
    EXPECT_DOUBLE_EQ(s.mean, 3.8);
    EXPECT_DOUBLE_EQ(s.mad, 1.0);  // deviations 2 1 0 1 6
    // Squares of the deviations from 3.8: 7.84 + 3.24 + 0.64 + 0.04 + 27.04 = 38.8, over 4.
    EXPECT_DOUBLE_EQ(s.relative_deviation, std::sqrt(9.7) / 3.8);
}

TEST(Summary, OfAnEvenCountTakesTheMiddleOfTwo) {
    const report::Summary s = report::summarize(std::vector{1.0, 2.0, 4.0, 10.0});
    EXPECT_DOUBLE_EQ(s.median, 3.0);
    EXPECT_DOUBLE_EQ(s.mad, 1.5);  // deviations 2 1 1 7
    EXPECT_DOUBLE_EQ(s.first_quartile, 1.75);
    EXPECT_DOUBLE_EQ(s.third_quartile, 5.5);
}

TEST(Summary, OfOneSampleIsThatSample) {
    const report::Summary s = report::summarize(std::vector{2.5});
    EXPECT_DOUBLE_EQ(s.minimum, 2.5);
    EXPECT_DOUBLE_EQ(s.median, 2.5);
    EXPECT_DOUBLE_EQ(s.maximum, 2.5);
    EXPECT_DOUBLE_EQ(s.mad, 0.0);
    EXPECT_DOUBLE_EQ(s.relative_deviation, 0.0);
}

TEST(Summary, HasNoRelativeDeviationRoundZero) {
    EXPECT_TRUE(std::isinf(report::summarize(std::vector{-1.0, 1.0}).relative_deviation));
    EXPECT_DOUBLE_EQ(report::summarize(std::vector{0.0, 0.0}).relative_deviation, 0.0);
}

TEST(Statistics, OfNothingAreAnError) {
    const std::vector<double> none;
    EXPECT_EQ(errorText([&] { report::summarize(none); }), "statistics: no samples");
    EXPECT_EQ(errorText([&] { report::quantile(none, 0.5); }), "statistics: no samples");
    EXPECT_EQ(errorText([&] { report::framesPerSecond(none); }), "statistics: no samples");
    EXPECT_EQ(errorText([&] { report::lowRates(none, 0.01); }), "statistics: no samples");
}

TEST(Quantile, InterpolatesAsType7) {
    // R: quantile(c(1, 2, 4, 8), c(0, 0.1, 0.9, 1), type = 7) is 1.0 1.3 6.8 8.0.
    const std::vector values{8.0, 1.0, 4.0, 2.0};
    EXPECT_DOUBLE_EQ(report::quantile(values, 0.0), 1.0);
    EXPECT_DOUBLE_EQ(report::quantile(values, 0.1), 1.3);
    EXPECT_DOUBLE_EQ(report::quantile(values, 0.9), 6.8);
    EXPECT_DOUBLE_EQ(report::quantile(values, 1.0), 8.0);
}

TEST(FramesPerSecond, IsFramesOverTotalTime) {
    // Not the mean of the rates 100 and 33.3.
    EXPECT_DOUBLE_EQ(report::framesPerSecond(std::vector{10.0, 30.0}), 50.0);
}

TEST(LowRates, AreThreeDifferentThings) {
    std::vector<double> frames(300, 10.0);
    frames[7] = 100.0;
    frames[100] = 50.0;
    frames[200] = 40.0;
    const report::LowRates low = report::lowRates(frames, 0.01);
    // Position 299 * 0.99 = 296.01 of the sorted times: 0.01 of the way from 10 to 40 ms.
    EXPECT_NEAR(low.percentile, 1000.0 / 10.3, 1e-9);
    EXPECT_DOUBLE_EQ(low.mean, 1000.0 / ((100.0 + 50.0 + 40.0) / 3.0));  // the 3 longest of 300
    EXPECT_DOUBLE_EQ(low.integral, 1000.0 / 100.0);  // 1 % of 3160 ms is within the longest frame
}

TEST(LowRates, OfFewFramesTakeTheLongest) {
    const report::LowRates low = report::lowRates(std::vector{10.0, 20.0}, 0.001);
    EXPECT_NEAR(low.percentile, 1000.0 / 19.99, 1e-9);
    EXPECT_DOUBLE_EQ(low.mean, 50.0);
    EXPECT_DOUBLE_EQ(low.integral, 50.0);
}

TEST(LowRates, IntegrateOverSeveralFrames) {
    // Half of 100 ms is reached by the second frame.
    EXPECT_DOUBLE_EQ(
        report::lowRates(std::vector{10.0, 20.0, 30.0, 40.0}, 0.5).integral, 1000.0 / 30.0);
}

}  // namespace
}  // namespace benchmarks
