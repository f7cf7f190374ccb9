#include "benchmarks/measure/metrics.h"
#include "engine/instance.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace benchmarks::measure {
namespace {

using engine::FrameRecord;
using testing::ElementsAre;

std::vector<std::string> names(const report::CaseResult& result) {
    std::vector<std::string> all;
    for (const report::Metric& metric : result.metrics) all.push_back(metric.name());
    return all;
}

const report::Metric& metricOf(const report::CaseResult& result, const std::string& name) {
    static const report::Metric none;
    const auto found = std::ranges::find(result.metrics, name, &report::Metric::name);
    EXPECT_NE(found, result.metrics.end()) << name;
    return found == result.metrics.end() ? none : *found;
}

std::vector<engine::FrameRecord> framesOf(std::size_t count) {
    std::vector<engine::FrameRecord> frames(count);
    for (std::size_t i = 0; i < count; ++i) frames[i].interval = 10.0;
    return frames;
}

TEST(MissedCount, IsLessOnGpusAndAnyDifferenceOnProcessors) {
    const char* const evaluations = "tessellation_evaluation_invocations";
    using enum engine::DeviceType;
    struct Row {
        engine::DeviceType type;
        const char* statistic;
        std::uint64_t measured;
        std::optional<std::uint64_t> expected;
        std::optional<std::string> missed;
    };
    for (const Row& row : {
             Row{cpu, evaluations, 304640, 304640, std::nullopt},
             {cpu, evaluations, 304641, 304640, "expected 304640"},
             {cpu, evaluations, 304639, 304640, "expected 304640"},
             {discrete, evaluations, 304640, 304640, std::nullopt},
             {discrete, evaluations, 400000, 304640, std::nullopt},
             {discrete, evaluations, 304639, 304640, "expected at least 304640"},
             {integrated, "tessellation_control_patches", 953, 952, std::nullopt},
             {virtual_gpu, "tessellation_control_patches", 951, 952, "expected at least 952"},
             {discrete, "geometry_invocations", 121, 120, "expected 120"},
             {discrete, "geometry_primitives", 239, 240, "expected 240"},
             // A stage that must not run at all.
             {discrete, evaluations, 1, 0, "expected 0"},
             {discrete, evaluations, 7, std::nullopt, std::nullopt},
         }) {
        engine::DeviceInfo device;
        device.type = row.type;
        EXPECT_EQ(missedCount(row.statistic, row.measured, row.expected, device), row.missed)
            << engine::deviceTypeName(row.type) << ", " << row.statistic << ' ' << row.measured;
    }
}

TEST(Metrics, OfOverlappedFramesSayWhoWaitsForWhom) {
    std::vector<engine::FrameRecord> frames = framesOf(2);
    frames[0].device = 8.0;
    frames[1].device = 13.0;
    frames[0].gap = 2.0;
    frames[1].gap = -1.0;  // it began while the previous frame was at work
    for (engine::FrameRecord& frame : frames) {
        frame.record = 2.0;
        frame.submit = 1.0;
        frame.wait = 6.5;
    }
    report::CaseResult result;
    addOverlappedMetrics(frames, result);
    EXPECT_THAT(
        names(result), ElementsAre(
                           "fps", "frame.time", "frame.device.time", "cpu.record.time",
                           "cpu.submit.time", "cpu.wait.time", "gpu.wait.time"));
    EXPECT_THAT(metricOf(result, "fps").samples, ElementsAre(100.0));
    EXPECT_THAT(metricOf(result, "frame.time").samples, ElementsAre(10.0, 10.0));
    EXPECT_THAT(metricOf(result, "frame.device.time").samples, ElementsAre(8.0, 13.0));
    EXPECT_THAT(metricOf(result, "cpu.record.time").samples, ElementsAre(2.0, 2.0));
    EXPECT_THAT(metricOf(result, "cpu.submit.time").samples, ElementsAre(1.0, 1.0));
    EXPECT_THAT(metricOf(result, "cpu.wait.time").samples, ElementsAre(6.5, 6.5));
    EXPECT_THAT(metricOf(result, "gpu.wait.time").samples, ElementsAre(2.0, 0.0));
    for (const report::Metric& metric : result.metrics)
        EXPECT_EQ(metric.mode, report::Mode::overlapped);
}

// 98 frames of 10 ms and two of 40 ms, 1,060 ms in all. Percentile: quantile 0.99 is at position
// 98.01 of 0 ... 99, within the two: 25 fps. So is the single slowest frame, and 1 % of the time is
// within it.
TEST(Metrics, HaveLowsOfThreeKinds) {
    std::vector<engine::FrameRecord> frames = framesOf(100);
    frames[10].interval = frames[60].interval = 40.0;
    report::CaseResult result;
    addOverlappedMetrics(frames, result);
    for (const char* name : {"fps.low_1.percentile", "fps.low_1.mean", "fps.low_1.integral"}) {
        EXPECT_THAT(metricOf(result, name).samples, ElementsAre(25.0)) << name;
        EXPECT_EQ(metricOf(result, name).unit, "1/s");
    }
    EXPECT_THAT(names(result), testing::Not(testing::Contains(testing::HasSubstr("low_0_1"))));
}

// The device's own lows do not know of a host that wakes up late.
TEST(Metrics, HaveLowsOfTheDeviceToo) {
    std::vector<engine::FrameRecord> frames = framesOf(100);
    for (engine::FrameRecord& frame : frames) frame.device = 5.0;
    frames[10].interval = frames[60].interval = 40.0;
    report::CaseResult result;
    addOverlappedMetrics(frames, result);
    for (const char* kind : {"percentile", "mean", "integral"}) {
        EXPECT_THAT(metricOf(result, std::string("fps.low_1.") + kind).samples, ElementsAre(25.0));
        EXPECT_THAT(
            metricOf(result, std::string("fps.device_low_1.") + kind).samples, ElementsAre(200.0));
    }
}

// Passes of 3 ms and of 5 ms in two parts have three empty passes of 0.1 ms in them.
TEST(Metrics, OverlapIsWithoutEmptyPasses) {
    std::vector<engine::FrameRecord> isolated(3);
    for (engine::FrameRecord& frame : isolated)
        frame.passes = {{"a", 3.0, {}}, {.name = "b", .milliseconds = 5.0, .use = {}, .parts = 2}};
    std::vector<engine::FrameRecord> overlapped = framesOf(2);
    overlapped[1].interval = 7.0;
    report::CaseResult result;
    addOverlap(isolated, overlapped, 0.1, result);
    EXPECT_THAT(
        metricOf(result, "frame.overlap").samples,
        ElementsAre(testing::DoubleNear(-2.3, 1e-12), testing::DoubleNear(0.7, 1e-12)));
    report::CaseResult without;
    addOverlap(isolated, overlapped, {}, without);
    addOverlap(framesOf(2), overlapped, 0.1, without);
    EXPECT_THAT(without.metrics, testing::IsEmpty());
}

// If the share is less than one frame, a low would just be the slowest frame.
TEST(Metrics, HaveLowsOfEnoughFramesOnly) {
    const auto lows = [](std::size_t frames) {
        report::CaseResult result;
        addOverlappedMetrics(framesOf(frames), result);
        return std::ranges::count_if(result.metrics, [](const report::Metric& metric) {
            return metric.name().starts_with("fps.low");
        });
    };
    EXPECT_EQ(lows(99), 0);
    EXPECT_EQ(lows(100), 3);
    EXPECT_EQ(lows(999), 3);
    EXPECT_EQ(lows(1000), 6);
}

engine::FrameRecord used(double cpu, std::optional<double> instructions) {
    engine::FrameRecord frame;
    frame.use = {cpu, instructions};
    frame.passes = {{"wind", 1.0, {cpu / 4.0, instructions}}, {"strands", 1.0, {cpu / 2.0, {}}}};
    return frame;
}

TEST(Metrics, CountInstructionsWhereTheMachineDoes) {
    report::CaseResult result;
    addFrameUse(std::vector{used(8.0, 1e6), used(10.0, 2e6)}, result);
    EXPECT_THAT(names(result), ElementsAre("frame.cpu.time", "frame.instructions"));
    EXPECT_THAT(metricOf(result, "frame.cpu.time").samples, ElementsAre(8.0, 10.0));
    EXPECT_THAT(metricOf(result, "frame.instructions").samples, ElementsAre(1e6, 2e6));
    EXPECT_EQ(metricOf(result, "frame.instructions").unit, "1");
    report::CaseResult uncounted;
    addFrameUse(std::vector{used(8.0, 1e6), used(10.0, {})}, uncounted);
    EXPECT_THAT(names(uncounted), ElementsAre("frame.cpu.time"));
}

TEST(Metrics, TellWhatPassesUsed) {
    report::CaseResult result;
    addPassUse(std::vector{used(8.0, 1e6), used(12.0, 2e6)}, result);
    EXPECT_THAT(
        names(result),
        ElementsAre("pass.wind.cpu.time", "pass.wind.instructions", "pass.strands.cpu.time"));
    EXPECT_THAT(metricOf(result, "pass.wind.cpu.time").samples, ElementsAre(2.0, 3.0));
    EXPECT_THAT(metricOf(result, "pass.strands.cpu.time").samples, ElementsAre(4.0, 6.0));
    EXPECT_EQ(metricOf(result, "pass.strands.cpu.time").mode, report::Mode::wall_clock);
}

}  // namespace
}  // namespace benchmarks::measure
