#include "benchmarks/viewer/timings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace benchmarks::viewer {
namespace {

using engine::Timing;
using testing::ElementsAre;

engine::FrameRecord frameOf(double wall) {
    engine::FrameRecord frame;
    frame.wall = wall;
    return frame;
}

TEST(TimingHistory, KeepsTheNewestOfEachWay) {
    constexpr std::uint32_t kMore = 5;
    TimingHistory history;
    for (std::uint32_t i = 0; i < 3; ++i)
        history.add(frameOf(-1.0), engine::Timing::overlapped, 1000 + i);
    for (std::uint32_t i = 0; i < TimingHistory::kFrames + kMore; ++i)
        history.add(frameOf(i), engine::Timing::isolated, 2 * i);

    EXPECT_THAT(history.overlapped().numbers, ElementsAre(1000, 1001, 1002));
    const TimedFrames& isolated = history.isolated();
    ASSERT_EQ(isolated.records.size(), TimingHistory::kFrames);
    ASSERT_EQ(isolated.numbers.size(), TimingHistory::kFrames);
    for (std::uint32_t i = 0; i < TimingHistory::kFrames; ++i) {
        EXPECT_EQ(isolated.records[i].wall, i + kMore);
        EXPECT_EQ(isolated.numbers[i], 2 * (i + kMore));
    }
}

TEST(TimingHistory, IsAnotherOneOnceItIsCleared) {
    TimingHistory history;
    history.add(frameOf(1.0), engine::Timing::isolated, 0);
    history.add(frameOf(1.0), engine::Timing::overlapped, 1);
    const std::uint64_t before = history.revision();
    history.clear();
    EXPECT_EQ(history.isolated().size(), 0u);
    EXPECT_EQ(history.overlapped().size(), 0u);
    EXPECT_NE(history.revision(), before);
}

}  // namespace
}  // namespace benchmarks::viewer
