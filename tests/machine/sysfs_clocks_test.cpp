#include "benchmarks/measure/clocks.h"

#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "benchmarks/report/verdict.h"
#include "tests/temporary_folder.h"

namespace benchmarks::measure {
namespace {

constexpr PciAddress kAddress{.domain = 0, .bus = 3, .device = 0, .function = 0};

// The files have the form in Linux's documentation of amdgpu.
class AmdgpuTest : public testing::Test {
protected:
    void write(const std::string& name, const std::string& text) {
        folder_.write("0000:03:00.0/" + name, text);
    }
    std::unique_ptr<ClockSource> open() const { return openAmdgpu(kAddress, folder_.path()); }

    TemporaryFolder folder_;
};

TEST_F(AmdgpuTest, IsAbsentWithoutFiles) { EXPECT_EQ(open(), nullptr); }

TEST_F(AmdgpuTest, IsAbsentForADriverWithoutLevels) {
    write("pp_dpm_sclk", "");
    EXPECT_EQ(open(), nullptr);
}

TEST_F(AmdgpuTest, ReadsThePresentLevels) {
    write("pp_dpm_sclk", "0: 500Mhz\n1: 1500Mhz *\n2: 2100Mhz\n");
    write("pp_dpm_mclk", "0: 96Mhz\n1: 1000Mhz *\n");
    const auto source = open();
    ASSERT_NE(source, nullptr);
    const ClockReading reading = source->read();
    EXPECT_EQ(reading.clock_mhz, 1500.0);
    EXPECT_EQ(reading.base_clock_mhz, 2100.0);
    EXPECT_EQ(reading.memory_clock_mhz, 1000.0);
    EXPECT_EQ(reading.temperature, std::nullopt);
    EXPECT_FALSE(reading.held);
}

TEST_F(AmdgpuTest, PrefersTheMeasuredClock) {
    write("pp_dpm_sclk", "0: 500Mhz\n1: 2100Mhz *\n");
    write("hwmon/hwmon4/freq1_input", "1873000000\n");
    write("hwmon/hwmon4/temp1_input", "53500\n");
    const ClockReading reading = open()->read();
    EXPECT_EQ(reading.clock_mhz, 1873.0);
    EXPECT_EQ(reading.temperature, 53.5);
}

TEST_F(AmdgpuTest, ReadsPowerAndLoad) {
    write("pp_dpm_sclk", "0: 500Mhz\n1: 2100Mhz *\n");
    EXPECT_EQ(open()->read().power_w, std::nullopt);
    write("hwmon/hwmon4/power1_input", "180000000\n");
    EXPECT_EQ(open()->read().power_w, 180.0);
    write("hwmon/hwmon4/power1_average", "212500000\n");
    write("gpu_busy_percent", "97\n");
    const ClockReading reading = open()->read();
    EXPECT_EQ(reading.power_w, 212.5);
    EXPECT_EQ(reading.load, 0.97);
}

TEST_F(AmdgpuTest, ReadsThePowerLimit) {
    write("pp_dpm_sclk", "0: 500Mhz\n1: 2100Mhz *\n");
    EXPECT_EQ(open()->powerLimit(), std::nullopt);
    write("hwmon/hwmon4/power1_cap", "203000000\n");
    EXPECT_EQ(open()->powerLimit(), 203.0);
}

// The table has the layout of the kernel's headers: 120 bytes, version 1.3, and the status from
// byte 112.
TEST_F(AmdgpuTest, NamesWhatHoldsTheClockBack) {
    write("pp_dpm_sclk", "0: 500Mhz\n1: 2100Mhz *\n");
    const auto reasons = [&](int bit, char minor = 3) {
        std::string table(120, '\0');
        table[0] = 120;
        table[2] = 1;
        table[3] = minor;
        if (bit >= 0)
            table[static_cast<std::size_t>(112 + bit / 8)] = static_cast<char>(1 << bit % 8);
        write("gpu_metrics", table);
        return open()->read().throttle_reasons;
    };
    using Reasons = std::vector<std::string>;
    EXPECT_EQ(reasons(-1), Reasons());
    EXPECT_EQ(reasons(0), Reasons{report::kPowerCap});
    EXPECT_EQ(reasons(15), Reasons{report::kPowerCap});
    EXPECT_EQ(reasons(16), Reasons{report::kCurrentLimit});
    EXPECT_EQ(reasons(31), Reasons{report::kCurrentLimit});
    EXPECT_EQ(reasons(32), Reasons{"thermal limit"});
    EXPECT_EQ(reasons(55), Reasons{"thermal limit"});
    EXPECT_EQ(reasons(56), Reasons());
    EXPECT_EQ(reasons(32, 4), Reasons());  // the table has another layout
}

TEST_F(AmdgpuTest, ReadsAgainEveryTime) {
    write("pp_dpm_sclk", "0: 500Mhz *\n1: 2100Mhz\n");
    const auto source = open();
    EXPECT_EQ(source->read().clock_mhz, 500.0);
    write("pp_dpm_sclk", "0: 500Mhz\n1: 2100Mhz *\n");
    EXPECT_EQ(source->read().clock_mhz, 2100.0);
}

TEST_F(AmdgpuTest, LeavesOutALevelThatIsNotMarkedOrNotANumber) {
    write("pp_dpm_sclk", "0: 500Mhz\n1: 2100Mhz\n");
    write("pp_dpm_mclk", "0: fast *\n");
    write("hwmon/hwmon0/temp1_input", "hot\n");
    const ClockReading reading = open()->read();
    EXPECT_EQ(reading.clock_mhz, std::nullopt);
    EXPECT_EQ(reading.memory_clock_mhz, std::nullopt);
    EXPECT_EQ(reading.temperature, std::nullopt);
}

TEST_F(AmdgpuTest, HoldsNoClockAgainstAnAdministratorsChoice) {
    write("pp_dpm_sclk", "0: 500Mhz *\n1: 2100Mhz\n");
    write("power_dpm_force_performance_level", "low\n");
    const ClockReading reading = open()->read();
    EXPECT_TRUE(reading.held);
    EXPECT_EQ(reading.base_clock_mhz, std::nullopt);
    write("power_dpm_force_performance_level", "auto\n");
    EXPECT_EQ(open()->read().base_clock_mhz, 2100.0);
}

// Linux, "GPU Power/Thermal Controls and Monitoring": profile_standard is a fixed clock for
// profiling.
TEST_F(AmdgpuTest, LocksByThePerformanceLevelAndPutsBackWhatWasThere) {
    const std::string level = "power_dpm_force_performance_level";
    write("pp_dpm_sclk", "0: 500Mhz\n1: 2100Mhz *\n");
    write(level, "high\n");
    const auto now = [&] {
        std::string text;
        std::ifstream(folder_.path() / "0000:03:00.0" / level) >> text;
        return text;
    };
    {
        const auto source = open();
        ASSERT_TRUE(source->lock());
        EXPECT_EQ(now(), "profile_standard");
        ASSERT_TRUE(source->lock());
    }
    EXPECT_EQ(now(), "high");
}

TEST_F(AmdgpuTest, LocksNothingWithoutALevel) {
    write("pp_dpm_sclk", "0: 500Mhz\n1: 2100Mhz *\n");
    const auto source = open();
    EXPECT_FALSE(source->lock());
    EXPECT_EQ(
        source->lockCommand(),
        "echo profile_standard > " +
            (folder_.path() / "0000:03:00.0" / "power_dpm_force_performance_level").string());
}

// The files have the names and units in Linux's documentation of i915
// (sysfs-driver-intel-i915-hwmon, intel_gt_sysfs_pm.c) and of xe (xe_gt_freq.c, xe_gt_throttle.c,
// sysfs-driver-intel-xe-hwmon).
struct IntelDriver {
    std::string unit;  // the folder of the clocks
    std::string act, min, max, rp0, reason;
};
const IntelDriver kIntelDrivers[] = {
    {"drm/card1/gt/gt0/", "rps_act_freq_mhz", "rps_min_freq_mhz", "rps_max_freq_mhz",
     "rps_RP0_freq_mhz", "throttle_reason_"},
    {"tile0/gt0/freq0/", "act_freq", "min_freq", "max_freq", "rp0_freq", "throttle/reason_"}};

class IntelTest : public testing::TestWithParam<IntelDriver> {
protected:
    IntelTest() {
        write(GetParam().act, "1850\n");
        write(GetParam().min, "300\n");
        write(GetParam().max, "2400\n");
        write(GetParam().rp0, "2400\n");
        folder_.write("0000:03:00.0/drm/renderD128/uevent", "");
    }
    void write(const std::string& name, const std::string& text) {
        folder_.write("0000:03:00.0/" + GetParam().unit + name, text);
    }
    void monitor(const std::string& name, const std::string& text) {
        folder_.write("0000:03:00.0/hwmon/hwmon5/" + name, text);
    }
    std::unique_ptr<ClockSource> open() const { return openIntel(kAddress, folder_.path()); }

    TemporaryFolder folder_;
};

TEST(Intel, IsAbsentWithoutFiles) {
    const TemporaryFolder folder;
    EXPECT_EQ(openIntel(kAddress, folder.path()), nullptr);
    folder.write("0000:03:00.0/drm/card1/uevent", "");  // another driver's card
    EXPECT_EQ(openIntel(kAddress, folder.path()), nullptr);
}

TEST_P(IntelTest, ReadsClocks) {
    const auto source = open();
    ASSERT_NE(source, nullptr);
    const ClockReading reading = source->read();
    EXPECT_EQ(reading.clock_mhz, 1850.0);
    EXPECT_EQ(reading.base_clock_mhz, 2400.0);
    EXPECT_EQ(reading.temperature, std::nullopt);
    EXPECT_EQ(reading.load, std::nullopt);
    EXPECT_FALSE(reading.idle);
    EXPECT_FALSE(reading.held);
    EXPECT_TRUE(reading.throttle_reasons.empty());
    EXPECT_EQ(source->energy(), std::nullopt);
    EXPECT_EQ(source->powerLimit(), std::nullopt);
    EXPECT_FALSE(source->lock());
}

TEST_P(IntelTest, TakesASleepingUnitForIdle) {
    write(GetParam().act, "0\n");
    const ClockReading reading = open()->read();
    EXPECT_TRUE(reading.idle);
    EXPECT_EQ(reading.clock_mhz, std::nullopt);
}

TEST_P(IntelTest, HoldsNoClockAgainstAnAdministratorsChoice) {
    write(GetParam().max, "1850\n");
    EXPECT_TRUE(open()->read().held);
    EXPECT_EQ(open()->read().base_clock_mhz, std::nullopt);
    write(GetParam().max, "2400\n");
    write(GetParam().min, "2400\n");
    EXPECT_TRUE(open()->read().held);
}

TEST_P(IntelTest, NamesWhatHoldsTheClockBack) {
    using Reasons = std::vector<std::string>;
    const std::pair<const char*, Reasons> reasons[] = {
        {"pl1", {report::kPowerCap}},     {"pl2", {report::kPowerCap}},
        {"pl4", {report::kCurrentLimit}}, {"vr_tdc", {report::kCurrentLimit}},
        {"thermal", {"thermal limit"}},   {"prochot", {"thermal limit"}},
        {"ratl", {"thermal limit"}},      {"vr_thermalert", {"thermal limit"}}};
    for (const auto& [file, names] : reasons) {
        write(GetParam().reason + file, "1\n");
        EXPECT_EQ(open()->read().throttle_reasons, names) << file;
        write(GetParam().reason + file, "0\n");
    }
    write(GetParam().reason + "pl1", "1\n");
    write(GetParam().reason + "pl2", "1\n");
    EXPECT_EQ(open()->read().throttle_reasons, Reasons{report::kPowerCap});
}

TEST_P(IntelTest, ReadsTheMonitorOfADiscreteBoard) {
    monitor("energy1_input", "7250000\n");
    monitor("power1_max", "190000000\n");
    monitor("temp2_input", "61000\n");
    const auto source = open();
    EXPECT_DOUBLE_EQ(source->energy().value(), 7.25);
    EXPECT_DOUBLE_EQ(source->powerLimit().value(), 190.0);
    EXPECT_DOUBLE_EQ(source->read().temperature.value(), 61.0);
}

INSTANTIATE_TEST_SUITE_P(BothDrivers, IntelTest, testing::ValuesIn(kIntelDrivers));

}  // namespace
}  // namespace benchmarks::measure
