#include "benchmarks/measure/trust.h"

#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "tests/decide/noise.h"

namespace benchmarks::measure {
namespace {

RoundTimes roundsOf(
    std::size_t rounds, std::size_t frames,
    const std::function<double(double round, double frame)>& time) {
    RoundTimes all(rounds);
    for (std::size_t round = 0; round < rounds; ++round)
        for (std::size_t frame = 0; frame < frames; ++frame)
            all[round].push_back(time(static_cast<double>(round), static_cast<double>(frame)));
    return all;
}

// Hair that unfolds: the 40th frame of every round takes twice as long as the first. Taken alone,
// the last 32 frames of any round rise.
TEST(Assessment, SeesNoDriftInFramesThatHaveMoreToDo) {
    Noise noise(1);
    const Assessment found = assess(roundsOf(6, 40, [&](double, double frame) {
        return (1.0 + frame / 39.0) * (1.0 + 0.01 * noise.normal());
    }));
    EXPECT_EQ(found.steady, true);
    EXPECT_EQ(found.settling, 0u);
    EXPECT_NEAR(found.median, 1.5, 0.02);  // noise of 1 %
}

TEST(Assessment, SeesARoundThatIsSlowerThanTheLast) {
    Noise noise(2);
    const Assessment found = assess(roundsOf(4, 10, [&](double round, double) {
        return (1.0 + 0.05 * round) * (1.0 + 0.001 * noise.normal());
    }));
    EXPECT_EQ(found.steady, false);
}

TEST(Assessment, DoesNotJudgeWhatItCannot) {
    const auto constant = [](double, double) { return 3.0; };
    EXPECT_EQ(assess(roundsOf(1, 100, constant)).steady, std::nullopt);
    EXPECT_EQ(assess(roundsOf(3, 10, constant)).steady, std::nullopt);
    EXPECT_EQ(assess(roundsOf(4, 8, constant)).steady, true);
    // Five times have no interval of 95 %: 2^(1 - 5) > 0.05.
    EXPECT_EQ(assess(roundsOf(1, 5, constant)).relative_half_width, std::nullopt);
    EXPECT_EQ(assess(roundsOf(1, 6, constant)).relative_half_width, 0.0);
}

// The interval contains the median of the noise, 1, as often as promised, although frames differ by
// a factor of two and the median over the profile 0.7 ... 1.4 is 1.05.
TEST(Assessment, SaysHowWellTheMedianIsKnown) {
    constexpr int kTrials = 500;
    Noise noise(3);
    int missed = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
        const Assessment found = assess(roundsOf(8, 15, [&](double, double frame) {
            return 0.7 * (1.0 + frame / 14.0) * std::exp(0.05 * noise.normal());
        }));
        ASSERT_TRUE(found.relative_half_width);
        missed += std::abs(found.median - 1.05) > *found.relative_half_width * found.median;
    }
    EXPECT_LE(missed, mostOf(kTrials, 0.05));
}

// Interference that comes and goes leaves fewer independent times than there are, whatever the
// frames' work. Here are 8 rounds of 25 frames; every round has one level with 10 % of noise, so
// there are about eight independent times. With independent times the width would be sqrt(25) = 5
// times smaller; a factor of two is a safe distance from both.
TEST(Assessment, CountsTimesForAsManyAsTheyAre) {
    Noise noise(4);
    double dependent = 0.0;
    double independent = 0.0;
    for (int trial = 0; trial < 50; ++trial) {
        double level = 0.0;
        const auto inRounds = [&](double, double frame) {
            if (frame == 0.0) level = 1.0 + 0.1 * noise.normal();
            return level * (1.0 + 0.001 * noise.normal());
        };
        dependent += assess(roundsOf(8, 25, inRounds)).relative_half_width.value_or(1.0);
        independent += assess(roundsOf(8, 25, [&](double, double) {
                           return 1.0 + 0.1 * noise.normal();
                       })).relative_half_width.value_or(1.0);
    }
    EXPECT_GT(dependent, 2.5 * independent);
}

// The whole has noise of 0.1 %. A part of a tenth with noise of 5 % decides, and one of a hundredth
// does not. 200 independent normal times know their median to 1.96 * 1.2533 / sqrt(200) = 17 % of
// their deviation: 0.87 % and 0.017 %. A factor of two allows for the interval's own scatter.
TEST(Assessment, KnowsThePartsToo) {
    Noise noise(5);
    const auto times = [&](double level, double deviation) {
        return roundsOf(
            8, 25, [&](double, double) { return level * (1.0 + deviation * noise.normal()); });
    };
    const RoundTimes whole = times(1.0, 0.001);
    const std::vector<RoundTimes> small{times(0.01, 0.05)},
        large{times(0.9, 0.001), times(0.1, 0.05)};
    const auto width = [&](std::span<const RoundTimes> parts) {
        return assess(whole, parts).relative_half_width.value_or(1.0);
    };
    EXPECT_LT(width({}), 0.00035);
    EXPECT_EQ(width(small), width({}));
    EXPECT_GT(width(large), 0.0043);
    EXPECT_LT(width(large), 0.0174);
}

TEST(Assessment, IsEnoughWhenSteadyAndPrecise) {
    const auto known = [](std::optional<bool> steady, std::optional<double> width) {
        return Assessment{.steady = steady, .relative_half_width = width};
    };
    EXPECT_TRUE(isEnough(known(true, 0.01), 0.01));
    EXPECT_FALSE(isEnough(known(true, 0.011), 0.01));
    EXPECT_FALSE(isEnough(known(false, 0.001), 0.01));
    EXPECT_FALSE(isEnough(known({}, 0.001), 0.01));
    EXPECT_FALSE(isEnough(known(true, {}), 0.01));
    EXPECT_FALSE(isEnough(known(true, 0.0), 0.0));  // 0 requests the whole max_time
}

}  // namespace
}  // namespace benchmarks::measure
