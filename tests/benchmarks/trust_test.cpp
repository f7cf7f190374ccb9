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

// Ratios 0.5, 1 and 0.75: the median is the middle one.
TEST(Trust, TakesTheMedianOfSumOverWall) {
    const std::vector frames{frame(10, 1, 4), frame(10, 2, 8), frame(20, 5, 10)};
    EXPECT_DOUBLE_EQ(measure::passSumOverWall(frames), 0.75);
}

TEST(Trust, BelievesTimestampsThatAgreeWithTheClock) {
    const std::vector stamped{frame(0, 0.1, 100), frame(0, 0.1, 130)};
    const std::vector clocked{frame(0, 0.2, 105), frame(0, 0.3, 140)};
    EXPECT_THAT(measure::timestampFaults(stamped, clocked), IsEmpty());
}

// A disturbed frame is longer, never shorter: the fastest frames are compared.
TEST(Trust, IsNotShakenByOneSlowFrame) {
    const std::vector stamped{frame(0, 0.1, 100), frame(0, 0.1, 100)};
    const std::vector clocked{frame(0, 0.1, 900), frame(0, 0.1, 101)};
    EXPECT_THAT(measure::timestampFaults(stamped, clocked), IsEmpty());
}

TEST(Trust, NamesThePassThatWasChargedTooLittleAndTheOneChargedTooMuch) {
    const std::vector stamped{frame(0, 25, 80)};
    const std::vector clocked{frame(0, 5, 100)};
    EXPECT_THAT(
        measure::timestampFaults(stamped, clocked),
        ElementsAre(
            "pass.wind: timestamps say 25.0 ms, the CPU's clock 5.00 ms",
            "pass.strands: timestamps say 80.0 ms, the CPU's clock 100 ms"));
}

// 2 % of the fastest frame, 102 ms, is 2.04 ms: beside 10 % and 0.5 ms, 4.7 ms for a pass of 2 ms
// are believed and 4.8 ms are not.
TEST(Trust, AllowsForAShareOfTheFrame) {
    const std::vector clocked{frame(0, 2, 100), frame(0, 2, 300)};
    EXPECT_THAT(measure::timestampFaults(std::vector{frame(0, 4.7, 100)}, clocked), IsEmpty());
    EXPECT_THAT(
        measure::timestampFaults(std::vector{frame(0, 4.8, 100)}, clocked), testing::SizeIs(1));
}

// A submission of its own costs a small pass more than it does itself.
TEST(Trust, AllowsForTheCostOfASubmission) {
    const std::vector stamped{frame(0, 0.01, 1.0)};
    const std::vector clocked{frame(0, 0.4, 1.5)};
    EXPECT_THAT(measure::timestampFaults(stamped, clocked), IsEmpty());
}

}  // namespace
}  // namespace benchmarks
