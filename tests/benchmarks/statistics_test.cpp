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
    // Differs from the mean of the rates 100 and 33.3.
    EXPECT_DOUBLE_EQ(report::framesPerSecond(std::vector{10.0, 30.0}), 50.0);
}

TEST(LowRates, AreThreeDifferentThings) {
    std::vector<double> frames(300, 10.0);
    frames[7] = 100.0;
    frames[100] = 50.0;
    frames[200] = 40.0;
    const report::LowRates low = report::lowRates(frames, 0.01);
    // Position 299 * 0.99 = 296.01 in the sorted times: 0.01 of the way from 10 to 40 ms.
    EXPECT_NEAR(low.percentile, 1000.0 / 10.3, 1e-9);
    EXPECT_DOUBLE_EQ(low.mean, 1000.0 / ((100.0 + 50.0 + 40.0) / 3.0));  // the 3 longest of 300
    EXPECT_DOUBLE_EQ(low.integral, 1000.0 / 100.0);  // 1 % of 3160 ms, which lies within the
                                                     // longest frame
}

// 1 % of 250 frames are 2.5 frames, and of 101 frames 1.01.
TEST(LowRates, CountABegunFrameAsAWholeOne) {
    std::vector<double> frames(250, 10.0);
    frames[7] = 100.0;
    frames[100] = 50.0;
    frames[200] = 40.0;
    EXPECT_DOUBLE_EQ(report::lowRates(frames, 0.01).mean, 1000.0 / ((100.0 + 50.0 + 40.0) / 3.0));
    frames.resize(101);
    EXPECT_DOUBLE_EQ(report::lowRates(frames, 0.01).mean, 1000.0 / ((100.0 + 50.0) / 2.0));
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

// Table of Student's t: two-sided 5 % with 1 to 30 degrees of freedom, one-sided 1 % with 5.
TEST(StudentQuantile, IsThatOfTheTable) {
    EXPECT_NEAR(report::studentQuantile(0.975, 1), 12.706, 5e-4);
    EXPECT_NEAR(report::studentQuantile(0.975, 2), 4.303, 5e-4);
    EXPECT_NEAR(report::studentQuantile(0.975, 3), 3.182, 5e-4);
    EXPECT_NEAR(report::studentQuantile(0.975, 4), 2.776, 5e-4);
    EXPECT_NEAR(report::studentQuantile(0.975, 10), 2.228, 5e-4);
    EXPECT_NEAR(report::studentQuantile(0.975, 30), 2.042, 5e-4);
    EXPECT_NEAR(report::studentQuantile(0.99, 5), 3.365, 5e-4);
    EXPECT_NEAR(report::studentQuantile(0.025, 4), -2.776, 5e-4);
    EXPECT_NEAR(report::studentQuantile(0.5, 7), 0.0, 1e-12);
    for (const double p : {0.0, 1.0, std::nan("")})
        EXPECT_NE(errorText([&] { report::studentQuantile(p, 3); }), "no error") << p;
    EXPECT_NE(errorText([] { report::studentQuantile(0.9, 0); }), "no error");
}

TEST(PowerLaw, IsThatOfPointsOnIt) {
    const std::vector<double> x{10.0, 100.0, 1000.0, 1000.0};
    std::vector<double> y;
    for (const double each : x) y.push_back(3.0 * std::pow(each, 1.25));
    const report::PowerLaw law = report::fitPowerLaw(x, y, 0.05);
    EXPECT_NEAR(law.exponent, 1.25, 1e-12);
    EXPECT_NEAR(law.factor, 3.0, 1e-11);
    EXPECT_NEAR(law.lower, 1.25, 1e-9);
    EXPECT_NEAR(law.upper, 1.25, 1e-9);
}

// The logarithms are 0 to 3 and 0, 1.1, 1.9, 3. Sums of squares and products are 5 and 4.9, so the
// exponent is 0.98. The residuals -0.03, 0.09, -0.09, 0.03 have the sum of squares 0.018, so the
// exponent's standard error is sqrt(0.018 / 2 / 5). t is 4.302653 with two degrees of freedom.
TEST(PowerLaw, HasTheIntervalOfLinearRegression) {
    const std::vector<double> x{1.0, std::exp(1.0), std::exp(2.0), std::exp(3.0)};
    const std::vector<double> y{1.0, std::exp(1.1), std::exp(1.9), std::exp(3.0)};
    const report::PowerLaw law = report::fitPowerLaw(x, y, 0.05);
    EXPECT_NEAR(law.exponent, 0.98, 1e-12);
    EXPECT_NEAR(law.factor, std::exp(0.03), 1e-12);
    const double half = 4.302653 * std::sqrt(0.018 / 2.0 / 5.0);
    EXPECT_NEAR(law.lower, 0.98 - half, 1e-6);
    EXPECT_NEAR(law.upper, 0.98 + half, 1e-6);
}

TEST(PowerLaw, KnowsNoIntervalOfTwoPoints) {
    const report::PowerLaw law =
        report::fitPowerLaw(std::vector{1.0, 4.0}, std::vector{2.0, 4.0}, 0.05);
    EXPECT_NEAR(law.exponent, 0.5, 1e-12);
    EXPECT_EQ(law.lower, -HUGE_VAL);
    EXPECT_EQ(law.upper, HUGE_VAL);
}

TEST(PowerLaw, RefusesWhatHasNone) {
    const auto refused = [](std::vector<double> x, std::vector<double> y) {
        return errorText([&] { report::fitPowerLaw(x, y, 0.05); }) != "no error";
    };
    EXPECT_TRUE(refused({1.0}, {1.0}));
    EXPECT_TRUE(refused({1.0, 2.0}, {1.0}));
    EXPECT_TRUE(refused({2.0, 2.0}, {1.0, 3.0}));
    EXPECT_TRUE(refused({0.0, 2.0}, {1.0, 3.0}));
    EXPECT_TRUE(refused({1.0, 2.0}, {-1.0, 3.0}));
    EXPECT_TRUE(refused({1.0, 2.0}, {1.0, std::nan("")}));
}

}  // namespace
}  // namespace benchmarks
