#include "benchmarks/measure/machine_watch.h"

#include <atomic>
#include <chrono>
#include <thread>

#include <gmock/gmock.h>

namespace benchmarks::measure {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Counts how often it is read.
class CountingSource : public ClockSource {
public:
    explicit CountingSource(std::atomic<int>& reads) : reads_(reads) {}
    ClockReading read() override { return {.clock_mhz = 1000.0 + ++reads_}; }

private:
    std::atomic<int>& reads_;
};

void waitForReads(const std::atomic<int>& reads, int count) {
    while (reads < count) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST(ClockSampler, ReadsOnceInTheShortestRound) {
    std::atomic<int> reads = 0;
    ClockSampler sampler(std::make_unique<CountingSource>(reads));
    sampler.begin();
    EXPECT_GE(sampler.end().size(), 1u);
}

TEST(ClockSampler, ReadsAgainAndAgainWhileARoundRuns) {
    std::atomic<int> reads = 0;
    ClockSampler sampler(std::make_unique<CountingSource>(reads));
    sampler.begin();
    waitForReads(reads, 2);
    const std::vector<ClockReading> readings = sampler.end();
    ASSERT_GE(readings.size(), 3u);
    for (std::size_t i = 0; i < readings.size(); ++i)
        EXPECT_EQ(readings[i].clock_mhz, 1001.0 + static_cast<double>(i));
}

TEST(ClockSampler, ForgetsTheRoundBefore) {
    std::atomic<int> reads = 0;
    ClockSampler sampler(std::make_unique<CountingSource>(reads));
    sampler.begin();
    waitForReads(reads, 1);
    sampler.end();
    const int before = reads;
    sampler.begin();
    const std::vector<ClockReading> readings = sampler.end();
    ASSERT_FALSE(readings.empty());
    EXPECT_GT(*readings.front().clock_mhz, 1000.0 + before);
}

TEST(AddClocks, LeavesOutReadingsOfAnIdleDevice) {
    report::Conditions conditions;
    addClocks(
        {{.clock_mhz = 300, .temperature = 30, .idle = true, .throttle_reasons = {"sync boost"}},
         {.clock_mhz = 1900, .temperature = 50, .throttle_reasons = {"power cap"}},
         {.clock_mhz = 1700, .temperature = 52, .throttle_reasons = {"power cap"}},
         {.clock_mhz = 1800, .base_clock_mhz = 1980, .throttle_reasons = {"power brake"}}},
        conditions);
    EXPECT_EQ(conditions.clock_mhz, 1800.0);
    EXPECT_EQ(conditions.base_clock_mhz, 1980.0);
    EXPECT_EQ(conditions.temperature, 51.0);
    EXPECT_EQ(conditions.memory_clock_mhz, std::nullopt);
    EXPECT_THAT(conditions.throttle_reasons, ElementsAre("power cap", "power brake"));
}

TEST(AddClocks, TakesAnIdleDeviceIfThereIsNothingElse) {
    report::Conditions conditions;
    addClocks({{.clock_mhz = 300, .idle = true}}, conditions);
    EXPECT_EQ(conditions.clock_mhz, 300.0);
    EXPECT_THAT(conditions.throttle_reasons, IsEmpty());
}

}  // namespace
}  // namespace benchmarks::measure
