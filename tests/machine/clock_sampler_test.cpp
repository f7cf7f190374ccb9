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

// A reading at the end of a round would describe an idle device.
TEST(ClockSampler, ReadsNothingForWhoTakes) {
    std::atomic<int> reads = 0;
    ClockSampler sampler(std::make_unique<CountingSource>(reads));
    sampler.begin();
    EXPECT_THAT(sampler.take(), IsEmpty());
}

TEST(ClockSampler, ReadsAgainAndAgainWhileARoundRuns) {
    std::atomic<int> reads = 0;
    ClockSampler sampler(std::make_unique<CountingSource>(reads));
    sampler.begin();
    waitForReads(reads, 3);
    const std::vector<ClockReading> readings = sampler.take();
    ASSERT_GE(readings.size(), 2u);  // the third may not have arrived yet
    for (std::size_t i = 0; i < readings.size(); ++i)
        EXPECT_EQ(readings[i].clock_mhz, 1001.0 + static_cast<double>(i));
}

TEST(ClockSampler, ForgetsTheRoundBefore) {
    std::atomic<int> reads = 0;
    ClockSampler sampler(std::make_unique<CountingSource>(reads));
    sampler.begin();
    waitForReads(reads, 2);
    const std::size_t before = sampler.take().size();
    waitForReads(reads, 5);
    const std::vector<ClockReading> readings = sampler.take();
    ASSERT_FALSE(readings.empty());
    EXPECT_EQ(readings.front().clock_mhz, 1001.0 + static_cast<double>(before));
}

// A driver that caches readings for a second reports the time before the round.
TEST(ClockSampler, LeavesOutWhatIsOlderThanTheRound) {
    struct Old : ClockSource {
        explicit Old(std::atomic<int>& count) : reads(count) {}
        ClockReading read() override {
            ++reads;
            return {.clock_mhz = 1000.0, .age = 60.0};
        }
        std::atomic<int>& reads;
    };
    std::atomic<int> reads = 0;
    ClockSampler sampler(std::make_unique<Old>(reads));
    sampler.begin();
    waitForReads(reads, 2);
    EXPECT_THAT(sampler.take(), IsEmpty());
}

// NVML's load is that of the last sixth of a second to a second (NVML API Reference,
// nvmlUtilization_t). A device at work seems idle for as long, and a driver without a lag is right.
TEST(ClockSampler, KeepsReadingsWithALoadOfBefore) {
    struct Late : ClockSource {
        Late(std::atomic<int>& count, double seconds) : reads(count), lag(seconds) {}
        ClockReading read() override {
            ++reads;
            return {.clock_mhz = 1980.0, .load = 0.0, .load_lag = lag};
        }
        std::atomic<int>& reads;
        double lag;
    };
    for (const double lag : {60.0, 0.0}) {
        std::atomic<int> reads = 0;
        ClockSampler sampler(std::make_unique<Late>(reads, lag));
        sampler.begin();
        waitForReads(reads, 2);
        const std::vector<ClockReading> readings = sampler.take();
        ASSERT_FALSE(readings.empty());
        EXPECT_EQ(readingsAtWork(readings).size(), lag > 0.0 ? readings.size() : 0u);
    }
}

TEST(ForgetLateLoad, BelievesALoadThatIsHighOrLateEnough) {
    const auto known = [](double load, double passed) {
        ClockReading reading{.load = load, .load_lag = 1.0};
        forgetLateLoad(reading, passed);
        return reading.load;
    };
    EXPECT_EQ(known(0.1, 0.9), std::nullopt);
    EXPECT_EQ(known(0.1, 1.0), 0.1);
    EXPECT_EQ(known(0.9, 0.1), 0.9);
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
    EXPECT_EQ(conditions.lowest_clock_mhz, 1700.0);
    EXPECT_EQ(conditions.base_clock_mhz, 1980.0);
    EXPECT_EQ(conditions.temperature, 51.0);
    EXPECT_EQ(conditions.memory_clock_mhz, std::nullopt);
    EXPECT_THAT(conditions.throttle_reasons, ElementsAre("power cap", "power brake"));
}

TEST(AddClocks, TakesTheLoadsWordWhereADriverCallsADeviceIdleThroughout) {
    report::Conditions conditions;
    addClocks(
        {{.clock_mhz = 1900, .load = 0.9, .idle = true},
         {.clock_mhz = 345, .load = 0.1, .idle = true},
         {.clock_mhz = 1980, .temperature = 40, .load = 1.0, .idle = true}},
        conditions);
    EXPECT_EQ(conditions.clock_mhz, 1940.0);
    EXPECT_EQ(conditions.lowest_clock_mhz, 1900.0);
    EXPECT_EQ(conditions.temperature, 40.0);
}

TEST(AddClocks, KnowsNothingOfADeviceThatWasIdleThroughout) {
    report::Conditions conditions;
    addClocks(
        {{.clock_mhz = 300, .idle = true}, {.clock_mhz = 400, .temperature = 40, .load = 0.1}},
        conditions);
    EXPECT_EQ(conditions.clock_mhz, std::nullopt);
    EXPECT_EQ(conditions.lowest_clock_mhz, std::nullopt);
    EXPECT_EQ(conditions.temperature, std::nullopt);
    EXPECT_THAT(conditions.throttle_reasons, IsEmpty());
}

}  // namespace
}  // namespace benchmarks::measure
