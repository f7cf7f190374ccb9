#include "benchmarks/measure/sampling.h"

#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "benchmarks/report/statistics.h"
#include "benchmarks/report/verdict.h"
#include "tests/decide/noise.h"

namespace benchmarks::measure {
namespace {

using testing::DoubleNear;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kFullClock = 1000.0;

using FrameTime = double engine::FrameRecord::*;

constexpr FrameTime kFrameTimes[] = {
    &engine::FrameRecord::interval, &engine::FrameRecord::wall, &engine::FrameRecord::record};

// A machine whose clock advances only with rounds and pauses.
struct Machine {
    std::function<double(int round, int frame)> time;                       // ms
    std::function<double(int round)> clock = [](int) { return kFullClock; };  // MHz
    std::function<double(int round)> memory_clock = [](int) { return kFullClock; };  // MHz
    std::optional<double> load{};
    std::function<std::vector<std::string>(int round)> reasons = [](int) {
        return std::vector<std::string>();
    };
    report::HighestClocks held{};  // before and then after
    // Times other than the judged one are those of a machine that slows down.
    FrameTime judged = &engine::FrameRecord::wall;
    int frames = 10;
    double now = 100.0;  // s
    int rounds = 0;
    double paused = 0.0;  // s
    std::vector<SamplingState> told{};

    SampledRounds sample(SamplingRule rule) {
        rule.mode = "isolated";
        rule.time = judged;
        return sampleRounds(
            rule,
            {.play =
                 [&] {
                     std::vector<engine::FrameRecord> round(static_cast<std::size_t>(frames));
                     for (int i = 0; i < frames; ++i) {
                         engine::FrameRecord& frame = round[static_cast<std::size_t>(i)];
                         for (const FrameTime each : kFrameTimes)
                             frame.*each = 1000.0 + 100.0 * rounds;
                         frame.*judged = time(rounds, i);
                         now += time(rounds, i) * 1e-3;
                     }
                     ++rounds;
                     return round;
                 },
             .conditions =
                 [&] {
                     return report::Conditions{
                         .clock_mhz = clock(rounds - 1),
                         .low_clock_mhz = clock(rounds - 1),
                         .memory_clock_mhz = memory_clock(rounds - 1),
                         .load = load,
                         .throttle_reasons = reasons(rounds - 1)};
                 },
             .seconds = [&] { return now; },
             .pause =
                 [&](double seconds) {
                     paused += seconds;
                     now += seconds;
                 },
             .progress = [&](const SamplingState& state) { told.push_back(state); }},
            &held);
    }
};

std::vector<double> walls(const SampledRounds& sampled) {
    std::vector<double> times;
    for (const engine::FrameRecord& frame : sampled.frames) times.push_back(frame.wall);
    return times;
}

TEST(SampleRounds, PlaysOneWithoutTime) {
    Machine machine{.time = [](int, int frame) { return 5.0 + frame; }};
    const SampledRounds sampled = machine.sample({.max_time = 0.0});
    EXPECT_THAT(
        walls(sampled),
        testing::ElementsAre(5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0));
    EXPECT_EQ(sampled.sampling.mode, "isolated");
    EXPECT_EQ(sampled.sampling.rounds, 1u);
    EXPECT_EQ(sampled.sampling.warmup_rounds, 0u);
    EXPECT_EQ(sampled.sampling.throttled_rounds, 0u);
    EXPECT_EQ(sampled.sampling.steady, std::nullopt);
    EXPECT_NEAR(sampled.sampling.seconds, 0.095, 1e-9);
    EXPECT_THAT(sampled.conditions, SizeIs(1));
}

// Rounds of 0.1 s until 32 times of 10 ms are steady. Only the judged time counts, whichever one it
// is.
TEST(SampleRounds, JudgesTheTimeThatTheRuleNames) {
    for (const FrameTime judged : kFrameTimes) {
        Machine machine{.time = [](int, int) { return 10.0; }, .judged = judged};
        const SampledRounds sampled = machine.sample({.precision = 0.01, .max_time = 60.0});
        EXPECT_EQ(sampled.sampling.steady, true);
        EXPECT_EQ(sampled.sampling.precision, 0.0);
        EXPECT_EQ(machine.rounds, 4);
        EXPECT_EQ(machine.told.back().median, 10.0);
        for (const engine::FrameRecord& frame : sampled.frames) EXPECT_EQ(frame.*judged, 10.0);
    }
}

// An overlapped frame has no wall clock of its own. The interval of other frames includes the wait
// for them and the CPU's work between frames.
TEST(SamplingRule, NamesTheTimeOfTheMode) {
    engine::FrameRecord frame;
    frame.interval = 1.0;
    frame.wall = 2.0;
    frame.device = 3.0;
    const hair::RunSettings run{.precision = 0.25f, .max_time = 7.0f};
    const auto rule = [&](engine::Timing timing) { return samplingRule(timing, run); };
    EXPECT_EQ(frame.*rule(engine::Timing::overlapped).time, 1.0);
    EXPECT_EQ(frame.*rule(engine::Timing::isolated).time, 2.0);
    EXPECT_EQ(frame.*rule(engine::Timing::wall_clock).time, 2.0);
    EXPECT_EQ(rule(engine::Timing::overlapped).mode, "overlapped");
    EXPECT_EQ(rule(engine::Timing::isolated).mode, "isolated");
    EXPECT_EQ(rule(engine::Timing::wall_clock).mode, "wall_clock");
    EXPECT_EQ(rule(engine::Timing::isolated).precision, 0.25);
    EXPECT_EQ(rule(engine::Timing::isolated).max_time, 7.0);
}

// The share of series with an interval that does not cover the median, 10 ms, after the stopping
// rule. Frames have 1 % of noise; `correlation` is that of neighbours.
double misleading(double correlation, int frames, double max_time) {
    constexpr int kSeries = 300;
    Noise noise(7);
    const double fresh = std::sqrt(1.0 - correlation * correlation);
    int missed = 0;
    for (int series = 0; series < kSeries; ++series) {
        double value = noise.normal();
        Machine machine{
            .time =
                [&](int, int) {
                    value = correlation * value + fresh * noise.normal();
                    return 10.0 * (1.0 + 0.01 * value);
                },
            .frames = frames};
        const std::vector<double> times =
            walls(machine.sample({.precision = 0.01, .max_time = max_time}));
        const report::MedianInterval interval =
            report::medianInterval(times, 0.05, report::effectiveSamples(times));
        missed += interval.lower > 10.0 || interval.upper < 10.0;
    }
    return static_cast<double>(missed) / kSeries;
}

// Intervals of 95 % that deserve the name miss at most 7 %, whatever the dependence and the time.
// Without caution, 18 % of them miss at a correlation of 0.9, and half at 0.98.
TEST(SampleRounds, GiveIntervalsThatCoverTheMedian) {
    for (const double correlation : {0.0, 0.8, 0.9, 0.98})
        for (const int frames : {5, 60})
            for (const double max_time : {0.3, 60.0})
                EXPECT_LE(misleading(correlation, frames, max_time), 0.07)
                    << correlation << ", rounds of " << frames << ", " << max_time << " s";
}

// Noise of 1 %: the median is known to 1 % long before 60 s, and all samples are kept.
TEST(SampleRounds, EndsWhenTheMedianIsKnown) {
    Noise noise(1);
    Machine machine{.time = [&](int, int) { return 10.0 * (1.0 + 0.01 * noise.normal()); }};
    const SampledRounds sampled = machine.sample({.precision = 0.01, .max_time = 60.0});
    EXPECT_EQ(sampled.sampling.steady, true);
    EXPECT_LE(sampled.sampling.precision.value_or(1.0), 0.01);
    EXPECT_LT(machine.rounds, 50);
    EXPECT_THAT(sampled.frames, SizeIs(10 * machine.rounds));
    EXPECT_THAT(machine.told, SizeIs(machine.rounds));
    EXPECT_EQ(machine.told.back().mode, "isolated");
    EXPECT_EQ(machine.told.back().max_seconds, 60.0);
    EXPECT_EQ(machine.told.back().rounds, static_cast<std::uint32_t>(machine.rounds));
    EXPECT_NEAR(machine.told.back().median, 10.0, 0.1);
}

// Rounds of 0.1 s: the last round begins before 2 s are over.
TEST(SampleRounds, EndsWhenTimeIsOver) {
    Noise noise(2);
    Machine machine{.time = [&](int, int) { return 7.0 + 6.0 * noise.uniform(); }};
    const SampledRounds sampled = machine.sample({.precision = 1e-4, .max_time = 2.0});
    EXPECT_GE(sampled.sampling.seconds, 2.0);
    EXPECT_LT(sampled.sampling.seconds, 2.0 + 0.13);
    EXPECT_GT(sampled.sampling.precision.value_or(0.0), 1e-4);
}

TEST(SampleRounds, TakesAllTheTimeForAPrecisionOfNothing) {
    Machine machine{.time = [](int, int) { return 10.0; }};
    EXPECT_THAT(machine.sample({.precision = 0.0, .max_time = 3.05}).frames, SizeIs(310));
}

TEST(SampleRounds, PlaysNoMoreThanAsked) {
    Machine machine{.time = [](int, int) { return 10.0; }};
    EXPECT_EQ(
        machine.sample({.precision = 0.0, .max_time = 60.0, .most_rounds = 7}).sampling.rounds, 7u);
}

// The first ten rounds settle from 40 % more, by 4 % each; the last two of them may stay.
TEST(SampleRounds, LeavesOutTheFirstWhileTheySettle) {
    Noise noise(3);
    Machine machine{.time = [&](int round, int) {
        return 10.0 * (1.0 + std::max(0.0, 0.4 - 0.04 * round) + 0.002 * noise.normal());
    }};
    const SampledRounds sampled = machine.sample({.precision = 0.0, .max_time = 5.0});
    EXPECT_GE(sampled.sampling.warmup_rounds, 8u);
    EXPECT_LE(sampled.sampling.warmup_rounds, 12u);
    EXPECT_EQ(
        sampled.sampling.warmup_rounds + sampled.sampling.rounds,
        static_cast<std::uint32_t>(machine.rounds));
    EXPECT_THAT(sampled.frames, SizeIs(10 * sampled.sampling.rounds));
    // 8 % in the last round but one, and ten standard deviations of the noise.
    EXPECT_THAT(walls(sampled), testing::Each(DoubleNear(10.0, 1.0)));
    EXPECT_THAT(sampled.conditions, SizeIs(machine.rounds));
}

TEST(SampleRounds, SaysWhatDriftsToTheEnd) {
    Machine machine{.time = [](int round, int) { return 10.0 + 0.2 * round; }};
    const SampledRounds sampled = machine.sample({.precision = 0.01, .max_time = 4.0});
    EXPECT_GE(sampled.sampling.seconds, 4.0);
    EXPECT_EQ(sampled.sampling.steady, false);
    EXPECT_EQ(sampled.sampling.warmup_rounds, 0u);
}

// Every third round, at 89 % of the others' clock, takes twice as long; at 91 % rounds count. The
// first round is judged after the second has had a higher clock.
TEST(SampleRounds, LeavesOutThrottledRounds) {
    Machine machine{
        .time = [](int round, int) { return round % 3 == 0 ? 20.0 : 10.0; },
        .clock = [](int round) { return std::array{890.0, 910.0, 1000.0}[round % 3]; }};
    const SampledRounds sampled = machine.sample({.precision = 0.0, .max_time = 3.0});
    EXPECT_THAT(walls(sampled), testing::Each(10.0));
    EXPECT_EQ(
        sampled.sampling.throttled_rounds, static_cast<std::uint32_t>((machine.rounds + 2) / 3));
    EXPECT_NEAR(machine.paused, 0.05 * (sampled.sampling.throttled_rounds - 1), 1e-9);
    EXPECT_THAT(sampled.conditions, SizeIs(machine.rounds));
    EXPECT_FALSE(sampled.all_throttled);
}

// Memory falls to its next lower level while the shaders keep their clock.
TEST(SampleRounds, LeavesOutRoundsWithSlowMemory) {
    Machine machine{
        .time = [](int round, int) { return round % 3 == 0 ? 20.0 : 10.0; },
        .memory_clock = [](int round) { return round % 3 == 0 ? 500.0 : 1000.0; },
        .load = 1.0};
    const SampledRounds sampled = machine.sample({.precision = 0.0, .max_time = 3.0});
    EXPECT_THAT(walls(sampled), testing::Each(10.0));
    EXPECT_EQ(
        sampled.sampling.throttled_rounds, static_cast<std::uint32_t>((machine.rounds + 2) / 3));
    EXPECT_EQ(machine.held.memory, 1000.0);
}

// Heat throttles a device at any clock.
TEST(SampleRounds, LeavesOutRoundsWithHeatOrPowerForAReason) {
    for (const char* reason :
         {"hardware slowdown", "software thermal slowdown", "hardware thermal slowdown",
          "power brake"}) {
        Machine machine{
            .time = [](int round, int) { return round % 4 == 2 ? 11.0 : 10.0; },
            .reasons =
                [&](int round) {
                    return round % 4 == 2 ? std::vector<std::string>{reason}
                                          : std::vector<std::string>{"sync boost"};
                }};
        const SampledRounds sampled = machine.sample({.precision = 0.0, .max_time = 3.0});
        EXPECT_THAT(walls(sampled), testing::Each(10.0)) << reason;
        EXPECT_GT(sampled.sampling.throttled_rounds, 0u) << reason;
    }
}

// A board at its limit of power or current is measured at the clock that it maintains.
TEST(SampleRounds, CountsRoundsAtTheBoardsLimitsWhileTheClockHolds) {
    for (const char* limit : {report::kPowerCap, report::kCurrentLimit}) {
        Machine machine{
            .time = [](int, int) { return 10.0; },
            .clock = [](int round) { return round % 3 == 0 ? 960.0 : 980.0 + round % 2 * 20.0; },
            .reasons = [&](int) { return std::vector<std::string>{limit}; }};
        const SampledRounds sampled = machine.sample({.precision = 0.0, .max_time = 3.0});
        EXPECT_EQ(
            sampled.sampling.throttled_rounds, static_cast<std::uint32_t>((machine.rounds + 2) / 3))
            << limit;
    }
}

// A clock locked below the board's rated clock is accepted like any other.
TEST(SampleRounds, TakesALockedClockForWhatItIs) {
    Machine machine{
        .time = [](int, int) { return 10.0; }, .clock = [](int) { return 300.0; }, .load = 1.0};
    EXPECT_EQ(machine.sample({.max_time = 0.0}).sampling.throttled_rounds, 0u);
    EXPECT_EQ(machine.held.shaders, 300.0);
}

// Under full load, the device reached 1,000 MHz in an earlier case.
TEST(SampleRounds, WaitsForADeviceToReachItsClock) {
    Machine machine{
        .time = [](int, int) { return 10.0; },
        .clock = [](int round) { return round < 4 ? 700.0 : 800.0; },
        .load = 1.0,
        .held = {.shaders = 1000.0}};
    const SampledRounds sampled = machine.sample({.max_time = 0.0});
    EXPECT_EQ(sampled.sampling.rounds, 1u);
    EXPECT_EQ(sampled.sampling.throttled_rounds, 4u);
    EXPECT_EQ(machine.held.shaders, 1000.0);
}

// A case with little work may run at a low clock, and does not tell the highest possible clock.
TEST(SampleRounds, DoesNotExpectAFullClockOfALightLoad) {
    for (const std::optional<double> load : {std::optional<double>(), std::optional(0.4)}) {
        Machine machine{
            .time = [](int, int) { return 10.0; },
            .clock = [](int) { return 500.0; },
            .load = load,
            .held = {.shaders = 1000.0}};
        EXPECT_EQ(machine.sample({.max_time = 0.0}).sampling.throttled_rounds, 0u);
        EXPECT_EQ(machine.held.shaders, 1000.0);
    }
}

TEST(SampleRounds, KeepsAndMarksWhatIsThrottledThroughout) {
    Machine machine{
        .time = [](int, int) { return 10.0; },
        .clock = [](int) { return 500.0; },
        .load = 1.0,
        .held = {.shaders = 1000.0}};
    const SampledRounds sampled = machine.sample({.max_time = 0.0});
    EXPECT_TRUE(sampled.all_throttled);
    EXPECT_EQ(sampled.sampling.throttled_rounds, kThrottledTries);
    EXPECT_THAT(sampled.frames, SizeIs(10 * kThrottledTries));
    EXPECT_THAT(machine.told, IsEmpty());
}

}  // namespace
}  // namespace benchmarks::measure
