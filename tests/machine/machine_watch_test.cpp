#include "benchmarks/measure/machine_watch.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <numeric>

#include <gmock/gmock.h>

#include "benchmarks/measure/clocks.h"
#include "benchmarks/report/verdict.h"
#include "engine/instance.h"
#include "tests/gpu_fixture.h"
#include "tests/temporary_folder.h"

namespace benchmarks::measure {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(MedianConditions, AreThoseOfTheRoundsThatKnow) {
    const report::Conditions median = medianConditions(
        {{.clock_mhz = 1500, .steal = 0.1, .throttle_reasons = {"power cap"}},
         {.clock_mhz = 1700, .temperature = 60},
         {.clock_mhz = 1000, .steal = 0.3, .throttle_reasons = {"power brake", "power cap"}}});
    EXPECT_EQ(median.clock_mhz, 1500.0);
    EXPECT_EQ(median.temperature, 60.0);
    EXPECT_DOUBLE_EQ(median.steal.value(), 0.2);
    EXPECT_EQ(median.base_clock_mhz, std::nullopt);
    EXPECT_EQ(median.other_load, std::nullopt);
    EXPECT_THAT(median.throttle_reasons, ElementsAre("power cap", "power brake"));
}

TEST(MedianConditions, OfNoRoundsAreUnknown) {
    const report::Conditions median = medianConditions({});
    EXPECT_EQ(median.clock_mhz, std::nullopt);
    EXPECT_THAT(median.throttle_reasons, IsEmpty());
}

// 90 J in 0.4 s are 225 W; a round without a counter adds nothing.
TEST(MeanPower, IsThatOfTheCounterBeforeThatOfReadings) {
    const auto power = meanPower(
        {{.power_w = 80, .energy_j = 30, .energy_s = 0.3},
         {.power_w = 70},
         {.power_w = 90, .energy_j = 60, .energy_s = 0.1}});
    ASSERT_TRUE(power);
    EXPECT_DOUBLE_EQ(power->watts, 225.0);
    EXPECT_TRUE(power->counted);
    // A counter that did not move tells nothing.
    const auto still = meanPower({{.power_w = 80, .energy_j = 0, .energy_s = 0.01}});
    ASSERT_TRUE(still);
    EXPECT_EQ(still->watts, 80.0);
    EXPECT_FALSE(still->counted);
    EXPECT_FALSE(meanPower({{.clock_mhz = 1000}}));
}

TEST(IsThrottled, BelowNineTenthsOfTheClockThatOtherRoundsHeld) {
    const auto at = [](double clock) {
        return report::Conditions{.clock_mhz = clock, .low_clock_mhz = clock};
    };
    EXPECT_TRUE(report::isThrottled(at(1799), {2000}, {}));
    EXPECT_FALSE(report::isThrottled(at(1800), {2000}, {}));
    EXPECT_FALSE(report::isThrottled(at(100), {}, {}));
    EXPECT_FALSE(report::isThrottled({.base_clock_mhz = 2000}, {2000}, {2000}));
}

// The bounds are those of shaders. A light load may leave memory at a lower level.
TEST(IsThrottled, BelowNineTenthsOfTheMemorysClockOfOtherRounds) {
    const auto at = [](double clock, double load) {
        return report::Conditions{
            .clock_mhz = 2000, .low_clock_mhz = 2000, .memory_clock_mhz = clock, .load = load};
    };
    EXPECT_TRUE(report::isThrottled(at(899, 0.5), {2000, 1000}, {}));
    EXPECT_FALSE(report::isThrottled(at(900, 0.5), {2000, 1000}, {}));
    EXPECT_FALSE(report::isThrottled(at(100, 0.5), {2000, 0}, {}));
    EXPECT_TRUE(report::isThrottled(at(749, 0.9), {2000, 749}, {2000, 1000}));
    EXPECT_FALSE(report::isThrottled(at(750, 0.9), {2000, 750}, {2000, 1000}));
    EXPECT_FALSE(report::isThrottled(at(100, 0.5), {2000, 100}, {2000, 1000}));
}

// A locked clock may be half the base clock.
TEST(IsThrottled, WhateverTheBaseClockIs) {
    EXPECT_FALSE(report::isThrottled(
        {.clock_mhz = 1000, .low_clock_mhz = 1000, .base_clock_mhz = 2000, .load = 1.0}, {1000},
        {1000}));
}

// The clock was low for part of a round only.
TEST(IsThrottled, ByTheLowClockRatherThanTheMedian) {
    EXPECT_TRUE(report::isThrottled({.clock_mhz = 2000, .low_clock_mhz = 1500}, {2000}, {}));
}

// A round of 0.25 s has about five readings. Two of them are no accident, and one of a longer
// round's twelve is, as are two of twelve.
TEST(IsThrottled, NotByASingleLowReading) {
    const auto with = [](std::size_t low, std::size_t all) {
        std::vector<ClockReading> readings(all, {.clock_mhz = 2000});
        for (std::size_t i = 0; i < low; ++i) readings[2 * i + 1].clock_mhz = 300;
        report::Conditions round;
        addClocks(readings, round);
        EXPECT_EQ(round.lowest_clock_mhz, low > 0 ? 300 : 2000);
        return report::isThrottled(round, {2000}, {2000});
    };
    for (const std::size_t all : {2u, 3u, 4u, 5u, 12u}) EXPECT_FALSE(with(1, all)) << all;
    EXPECT_TRUE(with(2, 5));
    EXPECT_FALSE(with(2, 12));
    EXPECT_TRUE(with(4, 12));
}

TEST(PciAddress, IsWrittenAsTheSystemDoes) {
    EXPECT_EQ(
        addressText({.domain = 0, .bus = 0xc1, .device = 0x1f, .function = 7}), "0000:c1:1f.7");
    EXPECT_EQ(
        addressText({.domain = 0x10000, .bus = 2, .device = 0, .function = 0}), "10000:02:00.0");
}

// FNV-1a of the bytes 1 to 16, by a program of its own.
TEST(BoardHash, TellsBoardsApartAndIsAbsentWithoutAUuid) {
    std::array<std::uint8_t, 16> uuid{};
    EXPECT_EQ(boardHash(uuid), "");
    std::iota(uuid.begin(), uuid.end(), std::uint8_t{1});
    EXPECT_EQ(boardHash(uuid), "e7ecfb4f6e006495");
}

// There are two packages, and one counter has wrapped: 3 J and 1.000001 J, worked out by hand.
TEST(EnergyCounters, AddPackagesUp) {
    const TemporaryFolder folder;
    const auto write = [&](const char* package, const char* microjoules) {
        folder.write(std::string(package) + "/energy_uj", microjoules);
        folder.write(std::string(package) + "/max_energy_range_uj", "262143328850\n");
    };
    EXPECT_TRUE(readEnergyCounters(folder.path()).empty());
    write("intel-rapl:0", "5000000\n");
    write("intel-rapl:0:0", "77\n");
    write("intel-rapl:1", "262143328850\n");
    const std::vector<EnergyCounter> before = readEnergyCounters(folder.path());
    ASSERT_EQ(before.size(), 2u);
    write("intel-rapl:0", "8000000\n");
    write("intel-rapl:1", "1000000\n");
    const std::vector<EnergyCounter> after = readEnergyCounters(folder.path());
    EXPECT_DOUBLE_EQ(joulesBetween(before, after).value(), 4.000001);
    EXPECT_EQ(joulesBetween(before, {}), std::nullopt);
    EXPECT_EQ(joulesBetween({}, {}), std::nullopt);
}

using MachineWatchTest = GpuTest;

TEST_F(MachineWatchTest, TellsSharesOfTheProcessorsTime) {
    MachineWatch watch(device());
    watch.begin();
    // Lasts for some ticks of /proc/stat.
    const auto start = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - start < std::chrono::milliseconds(100)) {
    }
    const report::Conditions conditions = watch.take();
    if (!conditions.other_load) GTEST_SKIP() << "/proc/stat tells nothing here";
    EXPECT_GE(*conditions.other_load, 0.0);
    EXPECT_LE(*conditions.other_load, 1.0);
    EXPECT_GE(conditions.steal.value(), 0.0);
    EXPECT_LE(*conditions.steal, 1.0);
}

TEST_F(MachineWatchTest, KnowsNoClockOfASoftwareDevice) {
    if (device().info().type != engine::DeviceType::cpu) GTEST_SKIP() << "this device has clocks";
    EXPECT_EQ(pciAddress(device().info()), std::nullopt);
    MachineWatch watch(device());
    watch.begin();
    const report::Conditions conditions = watch.take();
    EXPECT_EQ(conditions.clock_mhz, std::nullopt);
    EXPECT_EQ(conditions.base_clock_mhz, std::nullopt);
    EXPECT_FALSE(report::isThrottled(conditions, {}, {}));
    report::DeviceRecord record;
    addBoard(device().info(), record);
    EXPECT_EQ(record.board + record.pci_address, "");
    EXPECT_EQ(record.power_limit_w, std::nullopt);
}

// Whether clocks can be locked, and whether they are.
struct MadeUpClocks {
    bool may_lock = true;
    bool held = false;
    bool locked = false;
};

class MadeUpSource : public ClockSource {
public:
    explicit MadeUpSource(MadeUpClocks& clocks) : clocks_(clocks) {}
    ~MadeUpSource() override { unlock(); }
    ClockReading read() override { return {.held = clocks_.held}; }
    bool lock() override { return clocks_.locked = clocks_.may_lock; }
    void unlock() override { clocks_.locked = false; }
    std::string lockCommand() const override { return "lock 1410"; }

private:
    MadeUpClocks& clocks_;
};

// Returns the reason why the clocks can't be locked or left as `asked`; empty if they can.
std::string
refusal(hair::Clocks asked, std::unique_ptr<ClockSource> source, engine::DeviceType type) {
    engine::DeviceInfo device;
    device.name = "Card 7";
    device.type = type;
    try {
        const ClockHold hold(device, asked, std::move(source));
    } catch (const engine::Unsupported& error) {
        return error.what();
    }
    return {};
}

TEST(ClockHold, LocksClocksForAsLongAsItLives) {
    MadeUpClocks clocks;
    engine::DeviceInfo device;
    device.type = engine::DeviceType::discrete;
    {
        const ClockHold hold(device, hair::Clocks::locked, std::make_unique<MadeUpSource>(clocks));
        EXPECT_TRUE(clocks.locked);
    }
    EXPECT_FALSE(clocks.locked);
    const ClockHold free(device, hair::Clocks::free, std::make_unique<MadeUpSource>(clocks));
    EXPECT_FALSE(clocks.locked);
}

TEST(ClockHold, SaysWhatToDoWhereItCannot) {
    MadeUpClocks clocks{.may_lock = false, .held = true};
    const auto source = [&] { return std::make_unique<MadeUpSource>(clocks); };
    EXPECT_EQ(
        refusal(hair::Clocks::locked, source(), engine::DeviceType::discrete),
        "/run/clocks locked: the driver does not let this user lock clocks; as administrator, run "
        "lock 1410 and then measure without /run/clocks");
    EXPECT_EQ(
        refusal(hair::Clocks::free, source(), engine::DeviceType::discrete),
        "/run/clocks free: an administrator has locked the clocks of Card 7");
    EXPECT_EQ(
        refusal(hair::Clocks::free, nullptr, engine::DeviceType::discrete),
        "/run/clocks free: the clocks of Card 7 are not known");
    EXPECT_THAT(
        refusal(hair::Clocks::locked, source(), engine::DeviceType::cpu),
        testing::HasSubstr("cpupower"));
    EXPECT_EQ(refusal(hair::Clocks::as_found, source(), engine::DeviceType::cpu), "");
}

}  // namespace
}  // namespace benchmarks::measure
