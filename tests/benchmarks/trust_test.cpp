#include "benchmarks/measure/trust.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace benchmarks {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

engine::FrameRecord frame(double wall, double wind, double strands) {
    engine::FrameRecord record;
    record.wall = wall;
    record.passes = {{"wind", wind}, {"strands", strands}};
    return record;
}

TEST(Trust, AddsUpThePasses) { EXPECT_DOUBLE_EQ(measure::passSum(frame(0, 1.5, 20.25)), 21.75); }

TEST(Trust, FindsPassesThatOnlySomeFramesRun) {
    std::vector frames{frame(0, 1, 2), frame(0, 3, 4)};
    frames[0].passes.erase(frames[0].passes.begin());
    EXPECT_THAT(measure::passNames(frames), ElementsAre("strands", "wind"));
    EXPECT_THAT(measure::passTimes(frames, "wind"), ElementsAre(3.0));
}

// The ratios are 0.5, 1 and 0.75, with the median 0.75.
TEST(Trust, TakesTheMedianOfSumOverWall) {
    const std::vector frames{frame(10, 1, 4), frame(10, 2, 8), frame(20, 5, 10)};
    EXPECT_DOUBLE_EQ(measure::passSumOverWall(frames), 0.75);
}

// A frame takes 0.1 ms and its submission another 0.06 ms. A sum of 0.625 of the wall clock is then
// no reason to doubt the passes.
TEST(Trust, HoldsPassesAgainstTheDeviceAndTheWorkAlone) {
    std::vector frames{frame(0.16, 0.03, 0.07), frame(0.16, 0.03, 0.07)};
    for (engine::FrameRecord& each : frames) each.device = 0.1;
    const measure::PassSum sum = measure::passSums(frames, {.median = 0.06, .spread = 0.005});
    EXPECT_DOUBLE_EQ(sum.over_wall.value(), 0.625);
    EXPECT_DOUBLE_EQ(sum.over_device.value(), 1.0);
    EXPECT_NEAR(sum.over_work.value(), 1.0, 1e-12);
    EXPECT_FALSE(sum.incomplete);
    for (engine::FrameRecord& each : frames) each.device = 0.12;
    EXPECT_TRUE(measure::passSums(frames, {.median = 0.06, .spread = 0.005}).incomplete);
}

// 3 ms of 13 ms are in no pass, although the device's timestamps are covered by passes. That is 23
// % of the wall clock, and an empty submission takes only 0.06 ms.
TEST(Trust, FindsWorkThatNoStampHas) {
    std::vector frames{frame(13, 3, 7)};
    frames[0].device = 10.0;
    EXPECT_TRUE(measure::passSums(frames, {.median = 0.06, .spread = 0.005}).incomplete);
    EXPECT_FALSE(measure::passSums(frames, {.median = 3.0, .spread = 0.005}).incomplete);
}

TEST(Trust, KnowsNoSumWithoutTimestamps) {
    std::vector frames{frame(13, 3, 7)};
    frames[0].passes.clear();
    const measure::PassSum sum = measure::passSums(frames, {});
    EXPECT_FALSE(sum.over_wall || sum.over_device || sum.over_work || sum.incomplete);
}

TEST(Trust, TakesTheMedianOfEmptySubmissionsAndHowTheyVary) {
    std::vector<engine::FrameRecord> empty;
    for (int i = 0; i <= 20; ++i) empty.push_back(frame(1.0 + 0.01 * i, 0, 0));
    const measure::EmptySubmission found = measure::emptySubmission(empty);
    EXPECT_NEAR(found.median, 1.1, 1e-12);
    EXPECT_NEAR(found.spread, 0.09, 1e-12);
}

TEST(Trust, BelievesTimestampsThatAgreeWithTheClock) {
    const std::vector timestamped{frame(0, 0.1, 100), frame(0, 0.1, 130)};
    const std::vector clocked{frame(0, 0.2, 105), frame(0, 0.3, 140)};
    EXPECT_THAT(measure::timestampFaults(timestamped, clocked), IsEmpty());
}

// A disturbance only makes frames longer, so the fastest frames are compared.
TEST(Trust, IsNotShakenByOneSlowFrame) {
    const std::vector timestamped{frame(0, 0.1, 100), frame(0, 0.1, 100)};
    const std::vector clocked{frame(0, 0.1, 900), frame(0, 0.1, 101)};
    EXPECT_THAT(measure::timestampFaults(timestamped, clocked), IsEmpty());
}

TEST(Trust, NamesThePassThatWasChargedTooLittleAndTheOneChargedTooMuch) {
    const std::vector timestamped{frame(0, 25, 80)};
    const std::vector clocked{frame(0, 5, 100)};
    EXPECT_THAT(
        measure::timestampFaults(timestamped, clocked),
        ElementsAre(
            "pass.wind: timestamps say 25.0 ms, the CPU's clock 5.00 ms",
            "pass.strands: timestamps say 80.0 ms, the CPU's clock 100 ms"));
}

// 2 % of the fastest frame, 102 ms, is 2.04 ms. Together with 10 % and 0.5 ms, 4.7 ms for a pass of
// 2 ms are accepted and 4.8 ms are not.
TEST(Trust, AllowsForAShareOfTheFrame) {
    const std::vector clocked{frame(0, 2, 100), frame(0, 2, 300)};
    EXPECT_THAT(measure::timestampFaults(std::vector{frame(0, 4.7, 100)}, clocked), IsEmpty());
    EXPECT_THAT(
        measure::timestampFaults(std::vector{frame(0, 4.8, 100)}, clocked), testing::SizeIs(1));
}

// A separate submission adds cost to a small pass.
TEST(Trust, AllowsForTheCostOfASubmission) {
    const std::vector timestamped{frame(0, 0.01, 1.0)};
    const std::vector clocked{frame(0, 0.4, 1.5)};
    EXPECT_THAT(measure::timestampFaults(timestamped, clocked), IsEmpty());
}

}  // namespace
}  // namespace benchmarks
