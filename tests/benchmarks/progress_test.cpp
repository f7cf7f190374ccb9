#include "benchmarks/measure/progress.h"

#include <gtest/gtest.h>

#include "benchmarks/measure/measure.h"

namespace benchmarks {
namespace {

TEST(Progress, SaysNothingOfTheRestBeforeSomethingIsDone) {
    EXPECT_EQ(measure::progressText(1, 12, 0, 41.0), "[1/12] 0:41");
}

TEST(Progress, TakesTheRestToLastAsLongAsWhatIsDone) {
    // Two pieces took 50 s, and ten are left, including the current one.
    EXPECT_EQ(measure::progressText(3, 12, 2, 50.0), "[3/12] 0:50, about 4:10 left");
    // Nine existed already: only pieces of this run count for the estimate.
    EXPECT_EQ(measure::progressText(11, 12, 1, 30.0), "[11/12] 0:30, about 1:00 left");
    EXPECT_EQ(measure::progressText(2, 101, 1, 60.0), "[2/101] 1:00, about 1:40:00 left");
}

TEST(Progress, ShowsTheMedianAndItsInterval) {
    EXPECT_EQ(
        measure::samplingText(
            {.mode = "overlapped", .median = 12.345, .relative_half_width = 0.021}),
        "overlapped 12.3 ms +-2.10 %");
    EXPECT_EQ(measure::samplingText({.mode = "isolated", .median = 0.5}), "isolated 0.500 ms");
}

}  // namespace
}  // namespace benchmarks
