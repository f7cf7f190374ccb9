#include "benchmarks/measure/trust.h"
#include "tests/measure/simulated_gpu.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "benchmarks/gate/blocks.h"
#include "benchmarks/measure/measure.h"
#include "benchmarks/measure/metrics.h"
#include "benchmarks/measure/sampling.h"
#include "benchmarks/report/statistics.h"

namespace benchmarks::measure {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

report::CaseResult measuredOn(SimulatedGpu& gpu, hair::RunSettings run = {}) {
    report::CaseResult result;
    measureFrames(gpu, run, {.stop = [] { return false; }}, result);
    return result;
}

const report::Metric* metricIn(const report::CaseResult& result, const std::string& name) {
    const auto found = std::ranges::find(result.metrics, name, &report::Metric::name);
    return found == result.metrics.end() ? nullptr : &*found;
}

double medianIn(const report::CaseResult& result, const std::string& name) {
    const report::Metric* metric = metricIn(result, name);
    return metric ? report::quantile(metric->samples, 0.5) : std::nan("");
}

// A random machine with frames of 30 us to 30 ms.
GpuModel anyModel(std::mt19937_64& random, double throttled_share) {
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    GpuModel model;
    const double frame = 30e-6 * std::pow(1000.0, uniform(0.0, 1.0));  // s
    const double wind = uniform(0.02, 0.2), simulate = uniform(0.1, 0.4);
    model.passes = {
        {"wind", wind * frame * model.fast},
        {"simulate", simulate * frame * model.fast},
        {"strands", (1.0 - wind - simulate) * frame * model.fast}};
    model.stalls = uniform(0.0, 3.0);
    model.stall = uniform(1e-3, 4e-3);
    model.throttled_share = throttled_share;
    model.throttled_clock = uniform(0.5, 0.85);
    if (uniform(0.0, 1.0) < 0.5) model.throttle_reason = "hardware thermal slowdown";
    model.tells_age = uniform(0.0, 1.0) < 0.5;
    return model;
}

bool foundThrottling(const report::CaseResult& result) {
    return std::ranges::any_of(result.sampling, [](const report::Sampling& sampling) {
        return sampling.throttled_rounds > 0;
    });
}

// The bounds are those promised to readers of reports (docs/measuring.md): a median error within 1
// %, and 95 % of the cases within 3 %. If a frame occupies the device longer than the host needs
// between two frames, the frame's interval equals its device time.
TEST(SimulatedGpu, FrameTimesAreTrueWhateverTheMachineDoes) {
    std::vector<double> device, intervals, passes;
    for (std::uint32_t seed = 0; seed < 200; ++seed) {
        std::mt19937_64 random(seed);
        const bool throttles = seed % 3 == 0;
        const double share =
            throttles ? std::uniform_real_distribution<double>(0.05, 0.4)(random) : 0.0;
        SimulatedGpu gpu(anyModel(random, share), seed);
        const report::CaseResult result = measuredOn(gpu, {.max_time = 4.0f});
        EXPECT_EQ(result.status, report::Status::ok) << seed << ": " << result.reason;
        const auto error = [&](const std::string& name, double truth) {
            return std::abs(medianIn(result, name) / truth - 1.0);
        };
        device.push_back(error("frame.device.time", gpu.truth()));
        passes.push_back(error("pass.strands.time", gpu.truth("strands")));
        if (gpu.truth() > 0.2) intervals.push_back(error("frame.time", gpu.truth()));
    }
    ASSERT_GT(intervals.size(), 100u);
    for (const std::vector<double>* errors : {&device, &intervals, &passes}) {
        EXPECT_LE(report::quantile(*errors, 0.5), 0.01);
        EXPECT_LE(report::quantile(*errors, 0.95), 0.03);
    }
}

// Throttling must be found on 95 % of the machines that are throttled a fifth of the time, and on
// at most 1 % of those that never are. A mode is measured until its time is over, so that it meets
// some throttling.
TEST(SimulatedGpu, ThrottlingIsFoundWhereThereIsSomeAndNotElsewhere) {
    const hair::RunSettings run{.precision = 0.0f, .max_time = 6.0f};
    int found = 0, wrongly = 0;
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
        std::mt19937_64 random(1000 + seed);
        GpuModel model = anyModel(random, 0.2);
        SimulatedGpu throttled(model, seed);
        const report::CaseResult result = measuredOn(throttled, run);
        EXPECT_EQ(result.status, report::Status::ok) << result.reason;
        found += foundThrottling(result);
        model.throttled_share = 0.0;
        SimulatedGpu never(model, seed);
        wrongly += foundThrottling(measuredOn(never, run));
    }
    EXPECT_GE(found, 95);
    EXPECT_LE(wrongly, 1);
}

// After an hour of heat the case fails, and its measurements are in the report.
TEST(SimulatedGpu, ACaseThatIsThrottledThroughoutFailsAndKeepsItsSamples) {
    GpuModel model;
    model.throttled_share = 0.9999;
    model.throttle_reason = "hardware thermal slowdown";
    SimulatedGpu gpu(model, 1);
    gpu.pause(10.0);
    const report::CaseResult result = measuredOn(gpu);
    EXPECT_EQ(result.status, report::Status::failed);
    EXPECT_THAT(result.reason, HasSubstr("overlapped: heat or power throttled the device in all"));
    EXPECT_GT(medianIn(result, "frame.device.time"), gpu.truth());
    EXPECT_THAT(result.conditions.throttle_reasons, Contains("hardware thermal slowdown"));
}

// A frame of 1 ms at 300 W is 0.3 J. The device rested for 5 s at 60 W, and throttled rounds draw
// 150 W: neither counts. Stretches of heat may begin in the last moments of a counted round, which
// are less than a tenth of the counted time.
TEST(SimulatedGpu, EnergyIsThatOfTheCountedRounds) {
    GpuModel model;
    model.passes = {{"simulate", 480e3}, {"strands", 1500e3}};
    model.counts_energy = true;
    SimulatedGpu cool(model, 3);
    cool.pause(5.0);
    const report::CaseResult result = measuredOn(cool);
    EXPECT_EQ(result.conditions.energy_source, "counter");
    EXPECT_NEAR(medianIn(result, "frame.energy"), 0.3, 0.003);

    model.throttled_share = 0.3;
    model.throttle_reason = "hardware thermal slowdown";
    SimulatedGpu hot(model, 3);
    const report::CaseResult heated = measuredOn(hot, {.precision = 0.0f, .max_time = 10.0f});
    EXPECT_GT(heated.sampling[0].throttled_rounds, 0u);
    EXPECT_NEAR(medianIn(heated, "frame.energy"), 0.3, 0.015);

    model.counts_energy = false;
    SimulatedGpu uncounted(model, 3);
    EXPECT_EQ(measuredOn(uncounted).conditions.energy_source, "power");
}

// A submission and a wake-up take 20 us to 0.9 ms each, so isolated frames of 0.2 ms last 1.1 ms
// with a deviation of 0.36 ms. Their median is known to 1 % after 1.96^2 * pi / 2 * (0.36 / 1.1)^2
// / 1e-4 = 6,500 frames or 7 s. The passes' times do not depend on it: two rounds of a quarter of a
// second and the warm-up are enough, and two seconds are a generous bound.
TEST(SimulatedGpu, IsolatedFramesEndWhenTheirPassesAreKnown) {
    GpuModel model;
    model.most_latency = 0.9e-3;
    model.tail = 0.0;
    SimulatedGpu gpu(model, 5);
    const report::CaseResult result = measuredOn(gpu);
    ASSERT_EQ(result.sampling[1].mode, "isolated");
    EXPECT_LT(result.sampling[1].seconds, 2.0);
    EXPECT_EQ(result.sampling[1].steady, true);
    EXPECT_LE(result.sampling[1].precision.value(), 0.01);
    for (const char* pass : {"wind", "simulate", "strands"})
        EXPECT_NEAR(
            medianIn(result, "pass." + std::string(pass) + ".time") / gpu.truth(pass), 1.0, 0.01)
            << pass;
}

// Rounds measure for at least a quarter of a second, for any frames. The device never waits for the
// next round, or its clock would fall (it needs 2 ms to notice).
TEST(SimulatedGpu, RoundsAreLongAndNothingIsBetweenThem) {
    for (const double cycles : {60e3, 600e3, 6e6}) {
        GpuModel model;
        model.passes = {{"strands", cycles}};
        SimulatedGpu gpu(model, 7);
        const hair::RunSettings run{.precision = 0.0f, .max_time = 4.0f};
        const report::CaseResult result = measuredOn(gpu, run);
        for (const report::Sampling& sampling : result.sampling) {
            EXPECT_GE(sampling.rounds, 8u) << cycles;
            EXPECT_EQ(sampling.throttled_rounds, 0u);
        }
        const report::Metric* times = metricIn(result, "frame.time");
        ASSERT_TRUE(times);
        double measured = 0.0;
        for (const double time : times->samples) measured += time;
        EXPECT_GE(measured / result.sampling[0].rounds, 250.0) << cycles;
        EXPECT_EQ(
            times->samples.size(),
            std::size_t{result.sampling[0].rounds} * result.sampling[0].plays * run.frames);
        EXPECT_GE(result.conditions.lowest_clock_mhz.value(), 0.98 * 1980);
        EXPECT_THAT(result.trust.warnings, IsEmpty());
    }
}

// Frames of a play with different costs are the same in every round.
TEST(SimulatedGpu, PlaysShowTheSameFrames) {
    GpuModel model;
    model.least_latency = model.most_latency = 30e-6;
    model.tail = 0.0;
    model.profile = [](std::uint32_t frame) { return 1.0 + frame; };
    SimulatedGpu gpu(model, 3);
    const report::CaseResult result = measuredOn(gpu, {.warmup = 2, .frames = 3});
    const report::Metric* times = metricIn(result, "frame.device.time");
    ASSERT_TRUE(times);
    ASSERT_EQ(times->samples.size() % 3, 0u);
    // The tolerance of a hundredth allows for the end of the clock's rise.
    for (std::size_t i = 0; i < times->samples.size(); ++i)
        EXPECT_NEAR(times->samples[i] / gpu.truth(), 3.0 + static_cast<double>(i % 3), 1e-2);
}

// /run/max_time 0 requests one play and gets it.
TEST(SimulatedGpu, CountsAreCountsWithoutTime) {
    SimulatedGpu gpu(GpuModel{}, 5);
    const report::CaseResult result = measuredOn(gpu, {.frames = 7, .max_time = 0.0f});
    ASSERT_TRUE(metricIn(result, "frame.time"));
    EXPECT_EQ(metricIn(result, "frame.time")->samples.size(), 7u);
}

// 400,000 cycles at 1.98 GHz are 0.2 ms. Submitting and waiting take two latencies of 20 to 60 us
// and 2 us more. A frame's passes are therefore far from its wall clock, and nothing is wrong.
TEST(SimulatedGpu, AShortFrameIsNoReasonToDoubtItsPasses) {
    SimulatedGpu gpu(GpuModel{}, 9);
    const report::CaseResult result = measuredOn(gpu);
    EXPECT_LT(result.trust.pass_sum_over_wall.value(), 0.8);
    EXPECT_NEAR(result.trust.pass_sum_over_device.value(), 1.0, 1e-3);
    EXPECT_NEAR(result.trust.pass_sum_over_work.value(), 1.0, 0.1);
    EXPECT_NEAR(result.trust.empty_submission.value(), 0.082, 0.02);
    EXPECT_THAT(result.trust.warnings, IsEmpty());
    EXPECT_NEAR(medianIn(result, "frame.overlap"), 0.0, 0.01 * gpu.truth());
}

// A host that has waited for more than 0.3 ms wakes up 0.15 ms later, as one with an H200 did. A
// frame of 0.8 ms then has 0.23 ms of submission, and nothing is wrong with its passes.
TEST(SimulatedGpu, AHostThatFallsAsleepIsNoReasonToDoubtPasses) {
    GpuModel model;
    model.passes = {{"simulate", 84e3}, {"strands", 1500e3}};
    model.sleeps_after = 0.3e-3;
    model.sleep = 0.15e-3;
    SimulatedGpu gpu(model, 11);
    const report::CaseResult result = measuredOn(gpu);
    EXPECT_LT(result.trust.pass_sum_over_wall.value(), 0.8);
    EXPECT_NEAR(result.trust.pass_sum_over_work.value(), 1.0, 0.05);
    EXPECT_NEAR(result.trust.empty_submission.value(), 0.232, 0.03);
    EXPECT_THAT(result.trust.warnings, IsEmpty());
}

// The search for a work length ends even if timestamps stand still: after 32 frames of about 8 to
// 32 ms.
TEST(SimulatedGpu, StampsThatStandStillEndNoSearch) {
    GpuModel model;
    model.stamp_rate = 0.0;
    SimulatedGpu gpu(model, 13);
    const double begin = gpu.seconds();
    measureEmptySubmission(gpu, 1.0);
    EXPECT_LT(gpu.seconds() - begin, 1.5);
}

// A frame of 2 ms at 300 W takes 0.6 J. The tolerance is that of the frame time.
TEST(SimulatedGpu, AFrameTakesThePowerForItsTime) {
    GpuModel model;
    model.passes = {{"strands", 2e-3 * model.fast}};
    model.power = 300.0;
    SimulatedGpu gpu(model, 11);
    const report::CaseResult result = measuredOn(gpu);
    EXPECT_NEAR(medianIn(result, "frame.energy"), 0.6, 0.03 * 0.6);
    EXPECT_EQ(metricIn(result, "frame.energy")->id, report::ofFrame(report::Measured::energy));
}

// The host needs 0.5 ms for a frame, the device 1.9 ms at its lowest clock and 0.2 ms at its
// highest. Intervals are steady from the clock at which the device keeps up with the host.
TEST(SimulatedGpu, AWarmUpEndsWithTheDevicesTimeAndNotWithTheHosts) {
    GpuModel model;
    model.record = 0.5e-3;
    SimulatedGpu gpu(model, 11);
    RoundPlayer player(
        gpu.player(engine::Timing::overlapped), {.warmup = 2, .frames = 20},
        RoundPlayer::Counts::nothing, 2);
    player.round();
    const WarmUp found = warmUp(player, gpu, &engine::FrameRecord::interval, 0.0, 10.0);
    EXPECT_TRUE(found.steady);
    for (const engine::FrameRecord& frame : player.stream(1))
        EXPECT_NEAR(frame.device.value_or(0.0) / gpu.truth(), 1.0, 0.02);
}

// Overlap hides a third of the passes' time.
TEST(SimulatedGpu, OverlapIsFound) {
    GpuModel model;
    model.overlap = 1.0 / 3.0;
    model.passes = {{"simulate", 990e3}, {"strands", 1980e3}};
    SimulatedGpu gpu(model, 11);
    EXPECT_NEAR(medianIn(measuredOn(gpu), "frame.overlap"), 0.5, 0.02);
}

// Barriers and timestamps of isolated passes are no part of a frame, as on an H200 with 0.0086 ms.
TEST(SimulatedGpu, EmptyPassesAreNotSavedByOverlap) {
    GpuModel model;
    model.empty_pass = 8.6e-6;
    SimulatedGpu gpu(model, 9);
    const report::CaseResult result = measuredOn(gpu);
    EXPECT_NEAR(medianIn(result, "frame.overlap"), 0.0, 0.01 * gpu.truth());
}

// A frame of 0.2 ms is submitted while the previous one is at work, so the device never waits. The
// host's wake-ups make the intervals longer and shorter than the device's times.
TEST(SimulatedGpu, AHostThatWakesUpLateIsNoWaitOfTheDevice) {
    SimulatedGpu gpu(GpuModel{}, 9);
    const report::CaseResult result = measuredOn(gpu);
    EXPECT_LT(medianIn(result, "gpu.wait.time"), 1e-5);
}

// A frame takes the device 0.089 ms. With two frames in flight the next one has 0.089 ms to be
// submitted after a wait, and two latencies of 20 to 60 us and 7 us of recording need 0.087 ms on
// average: the device often waits, and that time is in the mean of several intervals too. With four
// frames in flight it has three times as long, which is enough except for the latest wake-ups.
TEST(SimulatedGpu, FourFramesInFlightHideTheHostOfShortFrames) {
    for (const std::uint32_t in_flight : {2u, 4u}) {
        GpuModel model;
        model.passes = {{"strands", 89e-6 * model.fast}};
        model.frames_in_flight = in_flight;
        SimulatedGpu gpu(model, 5);
        const report::CaseResult result = measuredOn(gpu, {.frames_in_flight = in_flight});
        const report::Metric* times = metricIn(result, "frame.time");
        ASSERT_TRUE(times);
        std::vector<double> means;  // of three intervals, more than 0.2 ms
        for (std::size_t i = 0; i + 3 <= times->samples.size(); i += 3)
            means.push_back(
                (times->samples[i] + times->samples[i + 1] + times->samples[i + 2]) / 3.0);
        const double error = medianIn(result, "frame.time") / gpu.truth() - 1.0;
        const double error_of_means = report::quantile(means, 0.5) / gpu.truth() - 1.0;
        if (in_flight == 2) {
            EXPECT_GT(error, 0.03);
            EXPECT_GT(error_of_means, 0.03);
        } else {
            EXPECT_NEAR(error, 0.0, 0.01);
        }
        EXPECT_NEAR(medianIn(result, "frame.device.time") / gpu.truth(), 1.0, 0.01);
    }
}

// ---- Gates of processes on the simulated GPU ----------------------------------------------------

// Medians of one process: frame.time, frame.cycles, pass.strands.time, pass.strands.cycles.
using Block = std::vector<double>;

struct Build {
    double work = 1.0;  // relative to the strands' cycles
    double clock = 1.0;  // relative to the device's
};

// Processes of a build, each on a device with a clock error of 0.4 %, as from temperature.
std::vector<Block> blocksOf(const Build& build, std::uint32_t first_seed) {
    std::vector<Block> blocks;
    for (std::uint32_t seed = first_seed; seed < first_seed + 60; ++seed) {
        std::mt19937_64 random(seed);
        GpuModel model;
        model.stalls = 1.0;
        model.fast *= build.clock * (1.0 + 0.004 * std::normal_distribution()(random));
        for (GpuModel::Pass& pass : model.passes) pass.cycles *= build.work;
        SimulatedGpu gpu(model, seed);
        report::CaseResult result;
        DeviceKnowledge known{.trusted_passes = {{"wind", "simulate", "strands"}}};
        measureFrames(
            gpu, {.max_time = 0.5f}, {.stop = [] { return false; }, .known = &known}, result);
        Block& block = blocks.emplace_back();
        for (const char* name :
             {"frame.time", "frame.cycles", "pass.strands.time", "pass.strands.cycles"})
            block.push_back(medianIn(result, name));
    }
    return blocks;
}

gate::Gate
playGate(const std::vector<Block>& a, const std::vector<Block>& b, std::mt19937_64& random) {
    gate::Gate gate({{.cycles = 1}, {.decides = false}, {.cycles = 3}, {.decides = false}});
    const auto any = [&](const std::vector<Block>& blocks) {
        return blocks[std::uniform_int_distribution<std::size_t>(0, blocks.size() - 1)(random)];
    };
    for (auto step = gate.next(); step != gate::Gate::Step::decided; step = gate.next())
        gate.add(any(step == gate::Gate::Step::run_a ? a : b));
    return gate;
}

bool callsRegression(const gate::Gate& gate) {
    return (gate.comparisons()[0].verdict == report::Verdict::regressed &&
            !gate.isClockChange(0)) ||
           (gate.comparisons()[2].verdict == report::Verdict::regressed && !gate.isClockChange(2));
}

// A gate's promises (docs/comparing.md): it finds 0 of 1,000 identical pairs of builds, and nine of
// ten that are 3 % slower, with 24 pairs. A clock that is 5 % lower is recognised as a clock
// change.
TEST(SimulatedGpu, GatesTellBuildsFromClocks) {
    const std::vector<Block> before = blocksOf({}, 1);
    const std::vector<Block> same = blocksOf({}, 1001);
    const std::vector<Block> slower = blocksOf({.work = 1.03}, 2001);
    const std::vector<Block> clocked_down = blocksOf({.clock = 0.95}, 3001);
    for (const auto* blocks : {&before, &same, &slower, &clocked_down})
        for (const Block& block : *blocks)
            for (const double median : block) ASSERT_TRUE(std::isfinite(median));
    std::mt19937_64 random(1);
    int alarms = 0;
    for (int i = 0; i < 1000; ++i) alarms += callsRegression(playGate(before, same, random));
    EXPECT_EQ(alarms, 0);
    int found = 0, clock_changes = 0, blamed = 0;
    constexpr int kGates = 200;
    for (int i = 0; i < kGates; ++i) {
        const gate::Gate gate = playGate(before, slower, random);
        found += callsRegression(gate) && gate.pairs() <= 24;
        const gate::Gate clocks = playGate(before, clocked_down, random);
        clock_changes += clocks.isClockChange(0) && clocks.isClockChange(2);
        blamed += callsRegression(clocks);
    }
    EXPECT_GE(found, kGates * 9 / 10);
    EXPECT_GE(clock_changes, kGates * 9 / 10);
    EXPECT_EQ(blamed, 0);
}

std::vector<std::string> faultsOf(const GpuModel& model) {
    SimulatedGpu gpu(model, 13);
    report::CaseResult result;
    return checkTimestamps(gpu, result);
}

TEST(SimulatedGpu, RightTimestampsAreBelieved) {
    EXPECT_THAT(faultsOf({}), IsEmpty());
    // As coarse as on some mobile GPUs.
    EXPECT_THAT(faultsOf({.period = 1000.0 / 19.2}), IsEmpty());
}

TEST(SimulatedGpu, TimestampsOfTwiceTheRateAreFound) {
    for (const double rate : {0.5, 2.0})
        for (const bool calibrated : {true, false})
            EXPECT_THAT(faultsOf({.stamp_rate = rate, .calibrated = calibrated}), Not(IsEmpty()))
                << rate;
    EXPECT_THAT(faultsOf({.stamp_rate = 2.0}), Contains(HasSubstr("run at 2.00 of the rate")));
    EXPECT_THAT(
        faultsOf({.stamp_rate = 2.0, .calibrated = false}),
        Contains(AllOf(HasSubstr("pass.strands"), HasSubstr("with planted work in strands"))));
}

// The passes take 10, 40 and 150 us, so their errors are far below the time of a submission.
TEST(SimulatedGpu, TimestampsOfTheNextPassAreFound) {
    const std::vector<std::string> faults = faultsOf({.timestamps_shifted = true});
    EXPECT_THAT(faults, Contains(AllOf(HasSubstr("pass.wind"), HasSubstr("work in wind"))));
    EXPECT_THAT(faults, Contains(AllOf(HasSubstr("pass.simulate"), HasSubstr("work in wind"))));
}

// 36 bits of 1 ns wrap every 69 s; the model's counter starts 1 ms before that.
TEST(SimulatedGpu, ACounterThatWrapsIsNoFault) {
    GpuModel model;
    model.valid_bits = 36;
    EXPECT_THAT(faultsOf(model), IsEmpty());
    SimulatedGpu gpu(model, 15);
    EXPECT_NEAR(medianIn(measuredOn(gpu), "frame.device.time") / gpu.truth(), 1.0, 1e-2);
}

// ---- Measuring in proportion --------------------------------------------------------------------

// A processor's passes: 2, 10 and 40 ms. The time of a submission is small beside them.
GpuModel processor() {
    GpuModel model;
    model.processor = true;
    model.waits_for_all = true;
    model.slow = model.fast;
    model.passes = {{"wind", 4e6}, {"simulate", 20e6}, {"strands", 80e6}};
    return model;
}

std::vector<engine::FrameRecord> framesOf(SimulatedGpu& gpu, engine::Timing timing) {
    const std::unique_ptr<Player> player = gpu.player(timing);
    for (int i = 0; i < 6; ++i) player->frame();
    return player->finish();
}

// Judges a device's timestamps in at most this many seconds; more is a failure.
TimestampJudgement judged(SimulatedGpu& gpu, double seconds, DeviceKnowledge* known = nullptr) {
    const auto isolated = framesOf(gpu, engine::Timing::isolated);
    const auto clocked = framesOf(gpu, engine::Timing::wall_clock);
    report::CaseResult result;
    const double begin = gpu.seconds();
    TimestampJudgement judgement = judgeTimestamps(gpu, isolated, clocked, seconds, known, result);
    EXPECT_LE(gpu.seconds() - begin, seconds);
    return judgement;
}

using Verdict = TimestampJudgement::Verdict;

// Overlapped and isolated modes have 2 warm-up frames, 2 counted frames and the one that ends them,
// and the first frame of all is played twice. A processor has one more before them, which fills the
// queue. A processor, and a device without timestamps, also has 2 more by the CPU's clock.
TEST(SimulatedGpu, AskedForCountsACaseIsFourteenFramesAtMost) {
    GpuModel unstamped;
    unstamped.valid_bits = 0;
    for (const auto& [model, frames] :
         {std::pair{GpuModel{}, 11u}, std::pair{processor(), 14u}, std::pair{unstamped, 13u}}) {
        SimulatedGpu gpu(model, 21);
        const report::CaseResult result =
            measuredOn(gpu, {.warmup = 2, .frames = 2, .max_time = 0.0f});
        EXPECT_LE(gpu.frames(), frames);
        for (const char* name : {"frame.time", "frame.isolated.time", "pass.strands.time"}) {
            ASSERT_TRUE(metricIn(result, name)) << name;
            EXPECT_EQ(metricIn(result, name)->samples.size(), 2u) << name;
        }
    }
}

// Nothing waits until as many frames have begun as may be in flight, and the first frame of all is
// waited for. Neither may be among the intervals, even if there is only one. A frame takes 52.5 ms;
// the host's part is two latencies of at most 60 us and 7 us.
TEST(SimulatedGpu, AFewFramesInTheFirstRoundHaveTheirWholeTime) {
    for (const bool is_processor : {false, true})
        for (const std::uint32_t warmup : {2u, 3u, 6u})
            for (const std::uint32_t frames : {1u, 2u, 5u}) {
                GpuModel model = processor();
                model.processor = model.waits_for_all = is_processor;
                model.tail = 0.0;
                SimulatedGpu gpu(model, 29);
                const report::CaseResult result =
                    measuredOn(gpu, {.warmup = warmup, .frames = frames, .max_time = 0.0f});
                const report::Metric* times = metricIn(result, "frame.time");
                ASSERT_TRUE(times);
                EXPECT_EQ(times->samples.size(), frames);
                for (const double time : times->samples)
                    EXPECT_NEAR(time, gpu.truth(), 0.127) << is_processor << ' ' << warmup;
            }
}

// Tests all time limits and frame lengths. Every pass that had enough time was checked.
TEST(SimulatedGpu, CheckingTimestampsTakesNoMoreThanItsTime) {
    for (const bool is_processor : {false, true})
        for (const double scale : {0.1, 1.0, 30.0})
            for (const double seconds : {0.0, 0.01, 0.1, 1.0, 10.0})
                for (const bool shifted : {false, true}) {
                    GpuModel model = is_processor ? processor() : GpuModel{};
                    for (GpuModel::Pass& pass : model.passes) pass.cycles *= scale;
                    model.timestamps_shifted = shifted;
                    SimulatedGpu gpu(model, 23);
                    const TimestampJudgement judgement = judged(gpu, seconds);
                    EXPECT_NE(judgement.verdict, shifted ? Verdict::right : Verdict::wrong)
                        << is_processor << ' ' << scale << ' ' << seconds;
                    if (seconds == 0.0 && !is_processor) {
                        EXPECT_EQ(judgement.verdict, Verdict::unchecked);
                    }
                }
    for (const GpuModel& model : {GpuModel{}, processor()}) {
        SimulatedGpu gpu(model, 25);
        EXPECT_EQ(judged(gpu, 1.0).verdict, Verdict::right);
        GpuModel shifted = model;
        shifted.timestamps_shifted = true;
        SimulatedGpu wrong(shifted, 25);
        EXPECT_EQ(judged(wrong, 1.0).verdict, Verdict::wrong);
    }
}

// Frames that a disturbance slowed down by half are not a fault of the timestamps. Alternating
// pairs tell; without time for them, the verdict is left open.
TEST(SimulatedGpu, ADisturbanceOfAProcessorIsNoFault) {
    SimulatedGpu gpu(processor(), 27);
    std::vector<engine::FrameRecord> slowed = framesOf(gpu, engine::Timing::isolated);
    for (engine::FrameRecord& frame : slowed)
        for (engine::PassTime& pass : frame.passes) pass.milliseconds *= 1.5;
    const auto clocked = framesOf(gpu, engine::Timing::wall_clock);
    report::CaseResult result;
    const std::uint32_t before = gpu.frames();
    const TimestampJudgement open = judgeTimestamps(gpu, slowed, clocked, 0.0, nullptr, result);
    EXPECT_EQ(open.verdict, Verdict::unchecked);
    EXPECT_THAT(open.faults, Contains(HasSubstr("pass.strands")));
    EXPECT_EQ(gpu.frames(), before);
    EXPECT_EQ(judgeTimestamps(gpu, slowed, clocked, 2.0, nullptr, result).verdict, Verdict::right);
    EXPECT_GT(gpu.frames(), before);
}

TEST(SimulatedGpu, TimestampsThatWereRightAreNotCheckedAgainInARun) {
    for (const GpuModel& model : {GpuModel{}, processor()}) {
        SimulatedGpu gpu(model, 29);
        DeviceKnowledge known;
        ASSERT_EQ(judged(gpu, 2.0, &known).verdict, Verdict::right);
        const std::uint32_t before = gpu.frames();
        EXPECT_EQ(judged(gpu, 2.0, &known).verdict, Verdict::right);
        EXPECT_EQ(gpu.frames(), before + 12);  // the frames to judge
    }
}

// A case has time for a pass or two; the next case of the run continues.
TEST(SimulatedGpu, WhatIsLeftOfACheckIsDoneInLaterCases) {
    SimulatedGpu gpu(GpuModel{}, 31);
    DeviceKnowledge known;
    int cases = 1;
    for (; cases < 20 && judged(gpu, 0.15, &known).verdict != Verdict::right; ++cases) {
    }
    EXPECT_GT(cases, 1);
    EXPECT_LE(cases, 3);
}

TEST(SimulatedGpu, ReportsSayWhetherTimestampsWereChecked) {
    SimulatedGpu gpu(GpuModel{}, 33);
    EXPECT_EQ(measuredOn(gpu).trust.timestamps, "right");
    EXPECT_EQ(measuredOn(gpu, {.max_time = 0.0f}).trust.timestamps, "unchecked");
    GpuModel model;
    model.timestamps_shifted = true;
    SimulatedGpu wrong(model, 33);
    EXPECT_EQ(measuredOn(wrong).trust.timestamps, "wrong");
}

TEST(SimulatedGpu, TimesAreAbsentWithoutTimestamps) {
    GpuModel model;
    model.valid_bits = 0;
    SimulatedGpu gpu(model, 17);
    const report::CaseResult result = measuredOn(gpu);
    EXPECT_FALSE(metricIn(result, "frame.device.time"));
    EXPECT_FALSE(metricIn(result, "gpu.wait.time"));
    EXPECT_FALSE(metricIn(result, "frame.overlap"));
    EXPECT_FALSE(result.trust.pass_sum_over_wall);
    const report::Metric* strands = metricIn(result, "pass.strands.time");
    ASSERT_TRUE(strands);
    EXPECT_EQ(strands->mode, report::Mode::wall_clock);
    EXPECT_THAT(result.trust.warnings, Contains("the device has no timestamps"));
}

}  // namespace
}  // namespace benchmarks::measure
