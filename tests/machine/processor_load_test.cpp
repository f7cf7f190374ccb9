#include "benchmarks/measure/machine_watch.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/temporary_folder.h"

namespace benchmarks::measure {
namespace {

std::optional<ProcessorTicks> ticksOf(const std::string& text) {
    const TemporaryFolder folder;
    return readProcessorTicks(folder.write("stat", text));
}

// Returns the duration of `ticks` in ms.
double milliseconds(double ticks) {
    return ticks * 1000.0 / static_cast<double>(sysconf(_SC_CLK_TCK));
}

// proc_stat(5): user nice system idle iowait irq softirq steal guest guest_nice. User time includes
// guest time.
TEST(ProcessorTicks, AddUpWhatProcStatMeans) {
    const auto ticks = ticksOf("cpu  100 20 30 1000 50 4 6 70 9 1\ncpu0 1 2 3 4 5 6 7 8 9 10\n");
    ASSERT_TRUE(ticks);
    EXPECT_EQ(ticks->busy, 100u + 20u + 30u + 4u + 6u);
    EXPECT_EQ(ticks->steal, 70u);
    EXPECT_EQ(ticks->total, 160u + 1000u + 50u + 70u);
}

TEST(ProcessorTicks, AreAbsentWhereTheFileIsNotUnderstood) {
    EXPECT_FALSE(readProcessorTicks("/no/such/file"));
    EXPECT_FALSE(ticksOf(""));
    EXPECT_FALSE(ticksOf("cpu0 1 2 3 4 5 6 7 8\n"));
    EXPECT_FALSE(ticksOf("cpu 1 2 3 4 5 6 7\n"));
    EXPECT_FALSE(ticksOf("cpu one two\n"));
}

TEST(ProcessorLoad, IsWhatIsBusyLessOwn) {
    const auto load = loadBetween(
        {.busy = 1000, .steal = 10, .total = 5000}, {.busy = 1060, .steal = 30, .total = 5200},
        milliseconds(40));
    ASSERT_TRUE(load);
    EXPECT_DOUBLE_EQ(load->others, (60.0 - 40.0) / 200.0);
    EXPECT_DOUBLE_EQ(load->steal, 20.0 / 200.0);
}

// The process's own time is known to the nanosecond. Busy time is in ticks that may not be counted
// yet.
TEST(ProcessorLoad, IsNeverNegative) {
    const auto load = loadBetween(
        {.busy = 1000, .steal = 10, .total = 5000}, {.busy = 1003, .steal = 10, .total = 5010},
        milliseconds(4));
    ASSERT_TRUE(load);
    EXPECT_EQ(load->others, 0.0);
    EXPECT_EQ(load->steal, 0.0);
}

TEST(ProcessorLoad, IsAbsentWithinATick) {
    const ProcessorTicks ticks{.busy = 1000, .steal = 10, .total = 5000};
    EXPECT_FALSE(loadBetween(ticks, ticks, 3.0));
    EXPECT_FALSE(loadBetween(ticks, {.busy = 1000, .steal = 10, .total = 4999}, 3.0));
}

TEST(ProcessorLoad, TakesACounterThatSteppedBackForNothing) {
    const auto load = loadBetween(
        {.busy = 1000, .steal = 10, .total = 5000}, {.busy = 999, .steal = 9, .total = 5100}, 0.0);
    ASSERT_TRUE(load);
    EXPECT_EQ(load->others, 0.0);
    EXPECT_EQ(load->steal, 0.0);
}

}  // namespace
}  // namespace benchmarks::measure
