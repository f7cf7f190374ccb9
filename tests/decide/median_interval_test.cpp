#include "benchmarks/report/statistics.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "tests/decide/noise.h"
#include "tests/decide/scipy_values.h"

namespace benchmarks::report {
namespace {

// Returns a stationary AR(1) series of variance 1.
std::vector<double> series(Noise& noise, std::size_t n, double correlation) {
    std::vector<double> values(n);
    values[0] = noise.normal();
    const double fresh = std::sqrt(1.0 - correlation * correlation);
    for (std::size_t i = 1; i < n; ++i)
        values[i] = correlation * values[i - 1] + fresh * noise.normal();
    return values;
}

TEST(MedianInterval, IsScipys) {
    for (const auto& row : scipyValues()["median_interval"]) {
        const auto values = row["values"].get<std::vector<double>>();
        const MedianInterval interval = medianInterval(values, row["alpha"]);
        EXPECT_EQ(interval.estimate, row["estimate"].get<double>()) << values.size();
        EXPECT_EQ(interval.lower, row["lower"].get<double>()) << values.size();
        EXPECT_EQ(interval.upper, row["upper"].get<double>()) << values.size();
        // Sums of logarithms have 1,001 times a rounding error.
        EXPECT_NEAR(interval.confidence, row["confidence"], 1e-11) << values.size();
    }
}

TEST(MedianInterval, OfTooFewIsInfinite) {
    const MedianInterval interval = medianInterval(std::vector{3.0, 1.0, 2.0, 5.0, 4.0}, 0.05);
    EXPECT_EQ(interval.estimate, 3.0);
    EXPECT_EQ(interval.confidence, 1.0);
    EXPECT_TRUE(std::isinf(relativeHalfWidth(interval)));
}

TEST(MedianInterval, IsWiderForFewerEffectiveSamples) {
    std::vector<double> values;
    for (int i = 1; i <= 1000; ++i) values.push_back(i);
    // A quarter of the samples gives twice the width, except for whole ranks of the 250.
    const MedianInterval all = medianInterval(values, 0.05);
    const MedianInterval quarter = medianInterval(values, 0.05, 250.0);
    EXPECT_NEAR((quarter.upper - quarter.lower) / (all.upper - all.lower), 2.0, 0.1);
    EXPECT_TRUE(std::isfinite(medianInterval(values, 0.05, kLeastEffective).upper));
    EXPECT_TRUE(std::isinf(medianInterval(values, 0.05, kLeastEffective - 1.0).upper));
}

TEST(MedianInterval, OfManySamplesDoesNotUnderflow) {
    // 2^-10000 is not a double. The half width in ranks is 1.96 sqrt(n) / 2 = 98, plus half a rank.
    std::vector<double> values;
    for (int i = 0; i < 10000; ++i) values.push_back(i);
    const MedianInterval interval = medianInterval(values, 0.05);
    EXPECT_NEAR(0.5 * (interval.upper - interval.lower), 98.0, 1.0);
    // One rank more at either end adds 2 * 2 / sqrt(n) * 0.058, where 0.058 is the normal density
    // at 1.96.
    EXPECT_GE(interval.confidence, 0.95);
    EXPECT_LE(interval.confidence, 0.95 + 0.0024);
}

TEST(EffectiveSamples, OfWhiteNoiseAreNearlyAll) {
    // In theory it equals the number of samples. The cut-off of the sum of correlations biases it
    // downward by a few times 1 / sqrt(n), and the caution about it by as much again.
    Noise noise(3);
    double sum = 0.0;
    for (int trial = 0; trial < 100; ++trial) sum += effectiveSamples(series(noise, 1000, 0.0));
    EXPECT_GT(sum / 100, 750.0);
}

TEST(EffectiveSamples, OfACorrelatedSeriesAreThoseOfTheory) {
    // If normal values have the correlation c, the indicators of being above the median have the
    // correlation 2/pi asin(c).
    constexpr double kCorrelation = 0.9;
    constexpr std::size_t kCount = 4000;
    double time = 1.0;
    for (int lag = 1; lag < 500; ++lag)
        time += 2.0 * 2.0 / std::numbers::pi * std::asin(std::pow(kCorrelation, lag));
    Noise noise(4);
    double mean = 0.0;
    for (int trial = 0; trial < 50; ++trial)
        mean += effectiveSamples(series(noise, kCount, kCorrelation)) / 50;
    // The noise of each estimate, some 15 %, falls to 2 % in the mean. Its second-order bias
    // remains.
    const double cautious = kCount / (time * (1.0 + 5.0 * std::sqrt((time - 1.0) / kCount)));
    EXPECT_NEAR(mean, cautious, 0.15 * cautious);
}

// The sums of products at neighbouring lags, counted by hand, are 21, 1, 9 and -3, so the initial
// monotone sequence is 21, 1 and 1 of 16.
TEST(EffectiveSamples, AddNoCorrelationThatRisesAgain) {
    const std::vector<double> values{1, 1, 1, 1, -1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, -1};
    const double time = -1.0 + 2.0 * (21.0 + 1.0 + 1.0) / 16.0;
    EXPECT_DOUBLE_EQ(
        effectiveSamples(values), 16.0 / (time * (1.0 + 5.0 * std::sqrt((time - 1.0) / 16.0))));
}

// A rising series lies below its median and then above it, so of n - lag pairs, lag <= n / 2, `lag`
// lie on different sides and the others on the same: the sum of products is n - 3 lag.
TEST(EffectiveSamples, OfARiseAreThoseOfTheory) {
    for (const int n : {100, 128, 1000}) {
        std::vector<double> rise;
        for (int i = 0; i < n; ++i) rise.push_back(0.5 * i);
        double time = -1.0;
        for (int lag = 0; 2 * n - 6 * lag - 3 > 0; lag += 2)
            time += 2.0 * (2.0 * n - 6.0 * lag - 3.0) / n;
        EXPECT_DOUBLE_EQ(
            effectiveSamples(rise),
            std::max(1.0, n / (time * (1.0 + 5.0 * std::sqrt((time - 1.0) / n)))));
    }
}

TEST(EffectiveSamples, OfAlternatingOrEqualOnesAreAll) {
    std::vector<double> alternating;
    for (int i = 0; i < 100; ++i) alternating.push_back(i % 2);
    EXPECT_EQ(effectiveSamples(alternating), 100.0);
    EXPECT_EQ(effectiveSamples(std::vector(7, 2.0)), 7.0);
    EXPECT_EQ(effectiveSamples(std::vector{1.0}), 1.0);
}

double coverage(double correlation, bool effective) {
    Noise noise(5);
    constexpr int kTrials = 1000;
    int covered = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
        const std::vector<double> values = series(noise, 400, correlation);
        const MedianInterval interval = effective
                                            ? medianInterval(values, 0.05, effectiveSamples(values))
                                            : medianInterval(values, 0.05);
        covered += interval.lower <= 0.0 && 0.0 <= interval.upper;
    }
    return static_cast<double>(covered) / kTrials;
}

TEST(MedianInterval, CoversTheMedianOfDependentSamples) {
    // The interval is for 95 %; 4 standard deviations of 1,000 trials are 2.8 %.
    EXPECT_GE(coverage(0.0, false), 0.95 - 0.028);
    EXPECT_GE(coverage(0.0, true), 0.95 - 0.028);
    EXPECT_GE(coverage(0.8, true), 0.95 - 0.028);
    // Dependent frames treated as independent would mislead: half the true width covers at most 70
    // %.
    EXPECT_LE(coverage(0.8, false), 0.75);
}

double precisionOf(const std::vector<double>& values) {
    return relativeHalfWidth(medianInterval(values, 0.05, effectiveSamples(values)));
}

TEST(Precision, IsReachedWhenTheMedianIsKnown) {
    // With 5 % noise the median is known to 1 % after about (1.96 * 1.2533 * 5)^2 = 151 samples.
    Noise noise(6);
    std::vector<double> frames;
    std::size_t reached = 0;
    while (reached == 0 && frames.size() < 2000) {
        frames.push_back(10.0 * (1.0 + 0.05 * noise.normal()));
        if (precisionOf(frames) <= 0.01) reached = frames.size();
    }
    EXPECT_GT(reached, 50u);
    EXPECT_LT(reached, 400u);
    EXPECT_EQ(precisionOf(std::vector(6, 4.0)), 0.0);  // the fewest samples that have an interval
                                                       // at 5 %
    EXPECT_EQ(precisionOf(std::vector(5, 4.0)), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace benchmarks::report
