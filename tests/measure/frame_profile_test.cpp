#include "benchmarks/measure/trust.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace benchmarks::measure {
namespace {

using testing::DoubleEq;
using testing::Each;
using testing::ElementsAre;
using testing::Pointwise;

// Rounds of 1, 3 and 1.5 times a profile. Relative to the median round, 1.5, they are 2/3, 2 and 1.
const RoundTimes kSlowerAndFaster{{2.0, 6.0, 4.0}, {6.0, 18.0, 12.0}, {3.0, 9.0, 6.0}};

TEST(FrameProfile, IsWhatAllRoundsShare) {
    const double low = 2.0 / 3.0;
    EXPECT_THAT(
        withoutProfile(kSlowerAndFaster),
        Pointwise(DoubleEq(), std::vector{low, low, low, 2.0, 2.0, 2.0, 1.0, 1.0, 1.0}));
}

TEST(FrameProfile, OfOneRoundIsAllOfIt) {
    EXPECT_THAT(withoutProfile({{5.0, 7.0, 1.0}}), Each(1.0));
    EXPECT_THAT(withoutProfile({}), testing::IsEmpty());
}

TEST(FrameProfile, TakesTimesOfNothingForEqual) {
    EXPECT_THAT(withoutProfile({{0.0, 2.0}, {0.0, 2.0}}), Each(1.0));
}

TEST(FrameProfile, LeavesALevelToEachRound) {
    EXPECT_THAT(roundLevels(kSlowerAndFaster), ElementsAre(DoubleEq(2.0 / 3.0), 2.0, 1.0));
}

TEST(FrameProfile, StringsRoundsTogether) {
    EXPECT_THAT(allTimes(RoundTimes{{1.0, 2.0}, {3.0, 4.0}}), ElementsAre(1.0, 2.0, 3.0, 4.0));
}

}  // namespace
}  // namespace benchmarks::measure
