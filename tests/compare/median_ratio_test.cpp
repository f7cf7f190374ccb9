#include "benchmarks/report/change.h"

#include <algorithm>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "tests/decide/noise.h"

namespace benchmarks::report {
namespace {

// Returns 1 ... 20 times `factor`, alternately below and above the median, so that all count as
// independent.
std::vector<double> inTurns(double factor) {
    std::vector<double> values;
    for (int i = 1; i <= 10; ++i)
        for (const int value : {i, 21 - i}) values.push_back(factor * value);
    return values;
}

TEST(MedianRatio, IsBoundedByBothIntervals) {
    // At 2.5 % for each report, 4 of 20 samples are cut off at either end, because
    // P(Binomial(20, 1/2) <= 4) is 0.59 % and P(<= 5) is 2.07 % (any table). So the intervals are
    // from the 5th to the 16th.
    const Comparison found = compareMedians(inTurns(1.0), inTurns(2.0), 0.02, 0.05);
    EXPECT_NEAR(found.lower, 10.0 / 16.0 - 1.0, 1e-12);
    EXPECT_NEAR(found.upper, 32.0 / 5.0 - 1.0, 1e-12);
}

TEST(MedianRatio, IsUnknownOfFewSamples) {
    const std::vector<double> few{1.0, 2.0, 3.0};
    const Comparison found = compareMedians(few, inTurns(1.0), 0.02, 0.05);
    EXPECT_EQ(found.lower, -1.0);  // the ratio is between 0 and infinity
    EXPECT_EQ(found.upper, std::numeric_limits<double>::infinity());
}

TEST(MedianRatio, HasThePOfTheLevelAtWhichTheIntervalsPart) {
    // Each interval runs from the 5th to the 16th of 20 samples. B's 5th over A's 16th exceeds 1.02
    // if the factor exceeds 16 / 5 * 1.02. The level of the pair of intervals is twice 2 * 0.59 %.
    const Comparison found = compareMedians(inTurns(1.0), inTurns(3.3), 0.02, 0.05);
    EXPECT_NEAR(found.p, 4.0 * 0.005909, 0.02 * 0.0236);
    EXPECT_NEAR(found.change, 2.3, 1e-12);
    EXPECT_EQ(compareMedians(inTurns(1.0), inTurns(1.01), 0.02, 0.05).p, 1.0);
}

TEST(MedianRatio, PassesTheFourVerdicts) {
    const auto make = [](double change, double lower, double upper, double p) {
        return Comparison{Verdict::inconclusive, change, lower, upper, 0.02, p};
    };
    std::vector<Comparison> all{
        make(0.1, 0.05, 0.15, 0.001), make(-0.1, -0.15, -0.05, 0.001), make(0.0, -0.01, 0.01, 1.0),
        make(0.03, -0.01, 0.05, 0.2)};
    passVerdicts(all, 0.05);
    EXPECT_EQ(all[0].verdict, Verdict::regressed);
    EXPECT_EQ(all[1].verdict, Verdict::improved);
    EXPECT_EQ(all[2].verdict, Verdict::same);
    EXPECT_EQ(all[3].verdict, Verdict::inconclusive);
    EXPECT_DOUBLE_EQ(all[0].p, 0.002);  // the second smallest of four: 0.001 * 4 / 2
}

TEST(MedianRatio, SaysNothingBeyondWhatManyMetricsAllow) {
    std::vector<Comparison> all(10, {Verdict::inconclusive, 0.0, -0.01, 0.01, 0.02, 1.0});
    all[0] = {Verdict::inconclusive, 0.1, 0.03, 0.2, 0.02, 0.01};
    passVerdicts(all, 0.05);
    EXPECT_EQ(all[0].verdict, Verdict::inconclusive);  // 0.01 * 10 is more than 0.05
}

// All samples are from one distribution, so only `same` and `inconclusive` are right.
TEST(MedianRatio, RaisesNoMoreFalseAlarmsThanItsLevel) {
    Noise noise(41);
    constexpr int kTrials = 1000;
    int alarms = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
        std::vector<double> a(40);
        std::vector<double> b(40);
        for (double& each : a) each = std::exp(0.1 * noise.normal());
        for (double& each : b) each = std::exp(0.1 * noise.normal());
        alarms += compareMedians(a, b, 0.0, 0.05).p <= 0.05;
    }
    EXPECT_LE(alarms, mostOf(kTrials, 0.05));
}

TEST(MedianRatio, FindsALargeChange) {
    Noise noise(42);
    constexpr int kTrials = 200;
    int found = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
        std::vector<double> a(100);
        std::vector<double> b(100);
        for (double& each : a) each = std::exp(0.05 * noise.normal());
        for (double& each : b) each = 1.1 * std::exp(0.05 * noise.normal());
        found += compareMedians(a, b, 0.02, 0.05).p <= 0.05;
    }
    // Each median's standard error is 0.0063. The change of 10 % is 8 points above the threshold,
    // nine standard errors of the difference.
    EXPECT_GE(found, kTrials * 95 / 100);
}

}  // namespace
}  // namespace benchmarks::report
