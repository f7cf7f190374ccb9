// The panel's figures for made-up frames with known medians.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "benchmarks/viewer/timings.h"
#include "tests/viewer/made_up_frames.h"

namespace benchmarks::viewer {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Optional;
using testing::Pair;

std::vector<std::string> names(const report::CaseResult& result) {
    std::vector<std::string> all;
    for (const report::Metric& metric : result.metrics) all.push_back(metric.name());
    return all;
}

// The viewer draws one frame at a time, so the runner's metrics of two frames in flight are
// unknown.
TEST(TimingsFigures, AreTheRunnersThatHoldForOneFrameAtATime) {
    const report::CaseResult result = frameMetrics(madeUpHistory(), engine::DeviceType::discrete);
    EXPECT_THAT(
        names(result), ElementsAre(
                           "frame.device.time", "cpu.record.time", "cpu.submit.time",
                           "frame.isolated.time", "pass.wind.time", "pass.strands.time"));
    const auto samples = [&](const report::MetricId& id) { return metricOf(result, id)->samples; };
    EXPECT_THAT(
        samples(report::ofFrame(report::Measured::device_time)), ElementsAre(22.0, 17.0, 18.0));
    EXPECT_THAT(samples(report::ofCpu(report::Measured::record_time)), ElementsAre(3.0, 3.0, 3.0));
    EXPECT_THAT(
        samples(report::ofFrame(report::Measured::isolated_time)), ElementsAre(12.0, 25.0, 63.0));
    EXPECT_THAT(
        samples(report::ofPass("strands", report::Measured::time)), ElementsAre(10.0, 20.0, 60.0));
    EXPECT_EQ(
        metricOf(result, report::ofFrame(report::Measured::device_time))->mode,
        report::Mode::overlapped);
    EXPECT_EQ(
        metricOf(result, report::ofPass("wind", report::Measured::time))->mode,
        report::Mode::isolated);
    EXPECT_EQ(metricOf(result, report::ofFrame(report::Measured::rate)), nullptr);
}

TEST(TimingsFigures, HaveCpuTimeOfSoftwareDevices) {
    const report::CaseResult result = frameMetrics(madeUpHistory(), engine::DeviceType::cpu);
    ASSERT_NE(metricOf(result, report::ofFrame(report::Measured::cpu_time)), nullptr);
    EXPECT_THAT(
        metricOf(result, report::ofFrame(report::Measured::cpu_time))->samples,
        ElementsAre(24.0, 50.0, 126.0));
}

TEST(TimingsFigures, TellHowFastFramesAre) {
    const auto rate = frameRate(frameMetrics(madeUpHistory(), engine::DeviceType::discrete));
    ASSERT_TRUE(rate);
    EXPECT_DOUBLE_EQ(rate->fps, 30.0);  // three frames in 100 ms
    EXPECT_EQ(rate->median, 25.0);
    EXPECT_FALSE(rate->low);
}

// 98 frames of 10 ms and two of 40 ms: these two are the slowest 1 % by every definition.
TEST(TimingsFigures, HaveLowsOfEnoughFrames) {
    TimingHistory history;
    for (std::uint32_t i = 0; i < 99; ++i)
        history.add(isolatedFrame(1.0, i % 50 == 7 ? 39.0 : 9.0), engine::Timing::isolated, i);
    EXPECT_FALSE(frameRate(frameMetrics(history, engine::DeviceType::discrete))->low);
    EXPECT_FALSE(passRows(history.isolated())->passes[1].high);
    history.add(isolatedFrame(1.0, 9.0), engine::Timing::isolated, 99);
    const auto rate = frameRate(frameMetrics(history, engine::DeviceType::discrete));
    ASSERT_TRUE(rate->low);
    EXPECT_EQ(rate->low->percentile, 25.0);
    EXPECT_EQ(rate->low->mean, 25.0);
    EXPECT_EQ(rate->low->integral, 25.0);
    // Position 98.01 of 0 ... 99 lies between the two longest.
    EXPECT_THAT(passRows(history.isolated())->passes[1].high, Optional(39.0));
}

TEST(TimingsFigures, TellPassesApart) {
    const auto rows = passRows(madeUpHistory().isolated());
    ASSERT_TRUE(rows);
    ASSERT_EQ(rows->passes.size(), 2u);
    const TimeSeries& strands = rows->passes[1];
    EXPECT_EQ(strands.name, "strands");
    EXPECT_THAT(strands.times, ElementsAre(10.0, 20.0, 60.0));
    EXPECT_THAT(strands.numbers, ElementsAre(4, 6, 8));
    EXPECT_EQ(strands.summary.median, 20.0);
    EXPECT_EQ(strands.summary.mad, 10.0);
    EXPECT_EQ(rows->sum.summary.median, 23.0);
    EXPECT_DOUBLE_EQ(rows->share(strands), 20.0 / 23.0);
    EXPECT_EQ(rows->find("strands"), &strands);
    EXPECT_EQ(rows->find("resolve"), nullptr);
}

// A time belongs to the frame that ran the pass.
TEST(TimingsFigures, KnowWhichFramesRanAPass) {
    TimingHistory history = madeUpHistory();
    engine::FrameRecord shadowed = isolatedFrame(1.0, 1.0);
    shadowed.passes.push_back({"hair_shadow", 5.0, {}});
    history.add(shadowed, engine::Timing::isolated, 10);
    history.add(isolatedFrame(1.0, 1.0), engine::Timing::isolated, 12);
    const auto rows = passRows(history.isolated());
    const TimeSeries* const shadow = rows->find("hair_shadow");
    ASSERT_NE(shadow, nullptr);
    EXPECT_THAT(shadow->times, ElementsAre(5.0));
    EXPECT_THAT(shadow->numbers, ElementsAre(10));
}

TEST(TimingsFigures, SplitAFrame) {
    const ShownSide shown = shownTimings(madeUpHistory(), engine::DeviceType::cpu);
    ASSERT_TRUE(shown.split);
    EXPECT_EQ(shown.split->record, 2.0);
    EXPECT_EQ(shown.split->submit, 1.0);
    EXPECT_EQ(shown.split->wait, 24.0);
    EXPECT_THAT(shown.split->cpu, Optional(50.0));
    EXPECT_EQ(shown.split->device, 23.0);
    EXPECT_EQ(shown.split->pass_sum, 23.0);
    EXPECT_THAT(shown.split->device_overlapped, Optional(18.0));
    EXPECT_THAT(shown.split->saved(), Optional(5.0));
    EXPECT_EQ(shown.isolated, 3u);
    EXPECT_EQ(shown.overlapped, 3u);
    EXPECT_THAT(shown.range, Optional(Pair(4u, 9u)));
}

// 11/12, 23/25 and 62/63 have the median 23/25.
TEST(TimingsFigures, SayHowFarPassesAreTheFrame) {
    const report::CaseResult good = frameMetrics(madeUpHistory(), engine::DeviceType::discrete);
    EXPECT_THAT(good.trust.pass_sum_over_wall, Optional(0.92));
    EXPECT_THAT(good.trust.warnings, IsEmpty());
    TimingHistory history;
    history.add(isolatedFrame(1.0, 4.0, 5.0), engine::Timing::isolated, 0);
    const report::CaseResult bad = frameMetrics(history, engine::DeviceType::discrete);
    EXPECT_THAT(
        bad.trust.warnings,
        Contains(HasSubstr("0.500 of its wall clock minus the time of a submission")));
}

TEST(TimingsFigures, OfNothingAreNone) {
    const ShownSide shown = shownTimings(TimingHistory(), engine::DeviceType::cpu);
    EXPECT_THAT(shown.metrics.metrics, IsEmpty());
    EXPECT_FALSE(shown.rate);
    EXPECT_FALSE(shown.passes);
    EXPECT_FALSE(shown.split);
    EXPECT_FALSE(shown.range);
}

}  // namespace
}  // namespace benchmarks::viewer
