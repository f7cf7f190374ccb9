#include "benchmarks/report/statistics.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/decide/noise.h"
#include "tests/decide/scipy_values.h"
#include "tests/error_text.h"

namespace benchmarks::report {
namespace {

// Both sides sum the same probabilities of at most 64 differences. Cancellation may cost p-values
// some 1e-14.
constexpr double kRounding = 1e-12;

TEST(SignedRank, HasScipysPValues) {
    for (const auto& row : scipyValues()["signed_rank"]) {
        const auto values = row["values"].get<std::vector<double>>();
        const SignedRankP p = signedRankP(values);
        EXPECT_NEAR(p.two_sided, row["two-sided"], kRounding) << values.size();
        EXPECT_NEAR(p.greater, row["greater"], kRounding) << values.size();
        EXPECT_NEAR(p.less, row["less"], kRounding) << values.size();
    }
}

TEST(SignedRank, HasTheIntervalThatScipysTestDoesNotReject) {
    std::size_t count = 0;
    for (const auto& row : scipyValues()["signed_rank"]) {
        const auto values = row["values"].get<std::vector<double>>();
        const MedianInterval interval = signedRankInterval(values, row["alpha"]);
        EXPECT_NEAR(interval.estimate, row["estimate"], kRounding) << values.size();
        if (!row.contains("lower")) continue;  // ties
        EXPECT_NEAR(interval.lower, row["lower"], kRounding) << values.size();
        EXPECT_NEAR(interval.upper, row["upper"], kRounding) << values.size();
        EXPECT_NEAR(interval.confidence, row["confidence"], kRounding) << values.size();
        ++count;
    }
    EXPECT_GT(count, 10u);
}

TEST(SignedRank, DistributionIsThatOfTheTables) {
    // Wilcoxon and Wilcox 1964, Some Rapid Approximate Statistical Procedures, table 2: critical
    // values of the smaller rank sum, two-sided.
    struct Critical {
        std::size_t n;
        std::size_t sum;
        double alpha;
    };
    constexpr Critical kTable[] = {{6, 0, 0.05},   {8, 3, 0.05},   {10, 8, 0.05},  {12, 13, 0.05},
                                   {16, 29, 0.05}, {20, 52, 0.05}, {25, 89, 0.05}, {8, 0, 0.01},
                                   {12, 7, 0.01},  {20, 37, 0.01}, {25, 68, 0.01}};
    for (const Critical& row : kTable) {
        const std::vector<double> distribution = signedRankDistribution(row.n);
        EXPECT_LE(2.0 * distribution[row.sum], row.alpha) << row.n;
        EXPECT_GT(2.0 * distribution[row.sum + 1], row.alpha) << row.n;
    }
}

TEST(SignedRank, DistributionOf64IsExact) {
    // The sums 0 to 4 have 1, 1, 1, 2 and 2 sets of different ranks.
    const std::vector<double> distribution = signedRankDistribution(64);
    ASSERT_EQ(distribution.size(), 64u * 65 / 2 + 1);
    EXPECT_DOUBLE_EQ(distribution[0], std::ldexp(1.0, -64));
    EXPECT_DOUBLE_EQ(distribution[4], std::ldexp(7.0, -64));
    EXPECT_NEAR(distribution.back(), 1.0, kRounding);
    // The distribution is symmetric about an even mean, 1040.
    EXPECT_NEAR(distribution[1039] + distribution[1040], 1.0, kRounding);
}

TEST(SignedRank, SmallestPOfNPairs) {
    for (int n = 1; n <= 12; ++n)
        EXPECT_DOUBLE_EQ(
            signedRankP(std::vector(static_cast<std::size_t>(n), 1.0)).two_sided,
            std::ldexp(1.0, 1 - n));
}

TEST(SignedRank, HasNoIntervalOfTooFew) {
    // 2^(1 - 5) exceeds 5 %.
    const MedianInterval interval = signedRankInterval(std::vector{1.0, 2.0, 3.0, 4.0, 5.0}, 0.05);
    EXPECT_EQ(interval.estimate, 3.0);
    EXPECT_TRUE(std::isinf(interval.lower) && std::isinf(interval.upper));
    EXPECT_EQ(interval.confidence, 1.0);
    EXPECT_EQ(signedRankInterval(std::vector{7.0}, 0.05).estimate, 7.0);
}

// Test and interval agree at both ends: a median beyond an end is rejected, and one within is not.
TEST(SignedRank, IntervalAndTestAreDual) {
    Noise noise(1);
    for (int trial = 0; trial < 100; ++trial) {
        std::vector<double> values(12);
        for (double& value : values) value = noise.normal();
        constexpr double kAlpha = 0.02;
        const MedianInterval interval = signedRankInterval(values, kAlpha);
        EXPECT_LE(signedRankP(values, interval.lower - 1e-9).two_sided, kAlpha);
        EXPECT_GT(signedRankP(values, interval.lower + 1e-9).two_sided, kAlpha);
        EXPECT_LE(signedRankP(values, interval.upper + 1e-9).two_sided, kAlpha);
        EXPECT_GT(signedRankP(values, interval.upper - 1e-9).two_sided, kAlpha);
    }
}

TEST(SignedRank, IntervalOfTiesIsWideEnough) {
    // Differences are -1, 0 or 1 ticks of a coarse clock, symmetric about 0.
    Noise noise(2);
    constexpr int kTrials = 2000;
    int missed = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
        std::vector<double> values(12);
        for (double& value : values) value = std::floor(3.0 * noise.uniform()) - 1.0;
        const MedianInterval interval = signedRankInterval(values, 0.05);
        missed += interval.lower > 0.0 || interval.upper < 0.0;
    }
    EXPECT_LE(missed, mostOf(kTrials, 0.05));
}

TEST(SignedRank, LeavesZerosOut) {
    EXPECT_EQ(signedRankP(std::vector{0.0, 0.0}).two_sided, 1.0);
    EXPECT_EQ(
        signedRankP(std::vector{0.0, 1.0, 2.0, 3.0}).greater,
        signedRankP(std::vector{1.0, 2.0, 3.0}).greater);
}

TEST(SignedRank, WantsFiniteDifferences) {
    const auto errorOf = [](std::vector<double> values) {
        return errorText([&] { signedRankInterval(values, 0.05); });
    };
    EXPECT_EQ(errorOf({}), "signed rank: no differences");
    EXPECT_EQ(errorOf({1.0, std::nan("")}), "signed rank: a difference is not finite");
    EXPECT_EQ(errorOf(std::vector(257, 1.0)), "signed rank: more than 256 differences");
}

}  // namespace
}  // namespace benchmarks::report
