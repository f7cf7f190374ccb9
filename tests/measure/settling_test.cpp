#include "benchmarks/measure/trust.h"

#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "tests/decide/noise.h"

namespace benchmarks::measure {
namespace {

std::vector<double> levels(std::size_t count, const std::function<double(double)>& level) {
    std::vector<double> all;
    for (std::size_t i = 0; i < count; ++i) all.push_back(level(static_cast<double>(i)));
    return all;
}

// With noise of 10 %, the tolerance of 1 % is of little use. The level of the tests limits how many
// series lose a round, for any number of rounds.
TEST(Settling, LeavesNothingOutOfNoise) {
    constexpr int kSeries = 1000;
    for (const std::size_t rounds : {8u, 9u, 20u, 64u, 200u}) {
        Noise noise(rounds);
        int wrong = 0;
        for (int i = 0; i < kSeries; ++i)
            wrong += settlingRounds(levels(
                         rounds, [&](double) { return 10.0 * (1.0 + 0.1 * noise.normal()); })) > 0;
        EXPECT_LE(wrong, mostOf(kSeries, SettlingRule{}.level)) << rounds << " rounds";
    }
}

// 30 % more at first, decaying by e every 4 rounds, with noise of 0.3 %. After the 8th round 4 %
// are left, which 30 or more rounds show clearly; after the 20th 0.2 %, below the tolerance.
TEST(Settling, LeavesOutWhatSettles) {
    for (const double sign : {1.0, -1.0}) {
        for (const std::size_t rounds : {50u, 60u}) {
            Noise noise(rounds);
            for (int trial = 0; trial < 100; ++trial) {
                const std::size_t left_out = settlingRounds(levels(rounds, [&](double i) {
                    return 1.0 + sign * 0.3 * std::exp(-i / 4.0) + 0.003 * noise.normal();
                }));
                EXPECT_GE(left_out, 8u);
                EXPECT_LE(left_out, 20u);
            }
        }
    }
}

// A device that warms up: 1 % more every round without end. Neither half is better than the other.
TEST(Settling, KeepsWhatDriftsToTheEnd) {
    Noise noise(3);
    for (int trial = 0; trial < 100; ++trial)
        EXPECT_EQ(
            settlingRounds(
                levels(40, [&](double i) { return 1.0 + 0.01 * i + 0.003 * noise.normal(); })),
            0u);
}

// Significant but irrelevant: 0.5 % over all rounds, half the tolerance.
TEST(Settling, OverlooksWhatDoesNotMatter) {
    EXPECT_EQ(settlingRounds(levels(30, [](double i) { return 1.0 - 0.005 * i / 30.0; })), 0u);
    EXPECT_GT(
        settlingRounds(levels(30, [](double i) { return i < 10.0 ? 1.2 - 0.02 * i : 1.0; })), 0u);
}

// Three rounds of 30 are all above the rest: by chance this happens once in binomial(30, 3) / 2 =
// 2,030 series. For a single round it happens once in 15.
TEST(Settling, LeavesOutAFewRoundsThatStandApart) {
    const auto slow = [](double count) {
        Noise noise(5);
        return settlingRounds(
            levels(30, [&](double i) { return (i < count ? 1.2 : 1.0) + 0.002 * noise.normal(); }));
    };
    // For the remaining two it happens once in binomial(29, 2) / 2 = 203: not significant.
    EXPECT_EQ(slow(3.0), 1u);
    EXPECT_EQ(slow(4.0), 2u);
    EXPECT_EQ(slow(1.0), 0u);
}

TEST(Settling, IsNotJudgedByAFewRounds) {
    EXPECT_EQ(settlingRounds({}), 0u);
    EXPECT_EQ(settlingRounds(levels(7, [](double i) { return 2.0 - 0.2 * i; })), 0u);
}

// 6,400 rounds in 64 blocks of 100: whole blocks are left out.
TEST(Settling, LooksAtLongSeriesInBlocks) {
    Noise noise(4);
    const std::size_t left_out = settlingRounds(levels(
        6400, [&](double i) { return 1.0 + 0.3 * std::exp(-i / 400.0) + 0.003 * noise.normal(); }));
    EXPECT_EQ(left_out % 100, 0u);
    EXPECT_GE(left_out, 800u);
    EXPECT_LE(left_out, 2000u);
}

}  // namespace
}  // namespace benchmarks::measure
