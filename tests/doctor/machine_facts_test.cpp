#include <array>
#include <cstdint>

#include <gmock/gmock.h>

#include "benchmarks/doctor/facts.h"
#include "tests/gpu_fixture.h"
#include "tests/temporary_folder.h"

namespace benchmarks::doctor {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(LayerLibrary, IsToldByItsName) {
    for (const char* path :
         {"/usr/lib/x86_64-linux-gnu/libVkLayer_khronos_validation.so",
          "libVkLayer_MESA_device_select.so", "/usr/lib/mangohud/libMangoHud.so",
          "/opt/renderdoc/librenderdoc.so", "/usr/lib/libvkbasalt.so",
          "/home/me/.steam/ubuntu12_64/steamoverlayvulkanlayer.so"})
        EXPECT_TRUE(isLayerLibrary(path)) << path;
    for (const char* path :
         {"", "/usr/lib/x86_64-linux-gnu/libvulkan.so.1", "libvulkan_lvp.so", "libc.so.6",
          "/opt/VkLayer/libm.so.6"})
        EXPECT_FALSE(isLayerLibrary(path)) << path;
}

using LoadedLayersTest = GpuTest;

// This program's device uses that layer.
TEST_F(LoadedLayersTest, NamesTheValidationLayer) {
    EXPECT_THAT(loadedLayers(), Contains(HasSubstr("khronos_validation")));
}

TEST(ScalingGovernors, AreEachNamedOnce) {
    const TemporaryFolder root;
    EXPECT_THAT(scalingGovernors(root.path()), IsEmpty());
    root.write("sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "powersave\n");
    root.write("sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "performance\n");
    root.write("sys/devices/system/cpu/cpu2/cpufreq/scaling_governor", "powersave\n");
    root.write("sys/devices/system/cpu/online", "0-2\n");
    EXPECT_THAT(scalingGovernors(root.path()), ElementsAre("performance", "powersave"));
}

TEST(ProcessorQuota, IsReadOfBothVersionsOfControlGroups) {
    const TemporaryFolder root;
    EXPECT_EQ(processorQuota(root.path()), std::nullopt);
    root.write("sys/fs/cgroup/cpu/cpu.cfs_quota_us", "-1\n");
    root.write("sys/fs/cgroup/cpu/cpu.cfs_period_us", "100000\n");
    EXPECT_EQ(processorQuota(root.path()), std::nullopt);
    root.write("sys/fs/cgroup/cpu/cpu.cfs_quota_us", "250000\n");
    EXPECT_EQ(processorQuota(root.path()), 2.5);
    root.write("sys/fs/cgroup/cpu.max", "150000 100000\n");
    EXPECT_EQ(processorQuota(root.path()), 1.5);
}

TEST(ProcessorQuota, IsAbsentWhereThereIsNoLimit) {
    const TemporaryFolder root;
    root.write("sys/fs/cgroup/cpu.max", "max 100000\n");
    EXPECT_EQ(processorQuota(root.path()), std::nullopt);
}

class OnBatteryTest : public testing::Test {
protected:
    void supply(const std::string& name, const std::string& file, const std::string& text) {
        root_.write("sys/class/power_supply/" + name + '/' + file, text + '\n');
    }
    std::optional<bool> onBattery() const { return doctor::onBattery(root_.path()); }

private:
    TemporaryFolder root_;
};

TEST_F(OnBatteryTest, IsNotToldWithoutSupplies) { EXPECT_EQ(onBattery(), std::nullopt); }

TEST_F(OnBatteryTest, SeesABatteryThatIsUsedUp) {
    supply("BAT0", "type", "Battery");
    supply("BAT0", "status", "Discharging");
    EXPECT_EQ(onBattery(), true);
    supply("BAT0", "status", "Charging");
    EXPECT_EQ(onBattery(), false);
}

TEST_F(OnBatteryTest, TrustsThePlug) {
    supply("BAT0", "type", "Battery");
    supply("BAT0", "status", "Discharging");
    supply("AC", "type", "Mains");
    supply("AC", "online", "0");
    EXPECT_EQ(onBattery(), true);
    supply("AC", "online", "1");
    EXPECT_EQ(onBattery(), false);
}

TEST_F(OnBatteryTest, DoesNotCareForAMouse) {
    supply("mouse", "type", "Battery");
    supply("mouse", "scope", "Device");
    supply("mouse", "status", "Discharging");
    EXPECT_EQ(onBattery(), std::nullopt);
}

// The counter advances by 32 ticks at a time and is read at least 96 ticks after the last time.
TEST(TimestampSteps, AreWhatStampsDifferBy) {
    const auto steps = timestampSteps(std::array<std::uint64_t, 6>{0, 0, 96, 224, 224, 224 + 320});
    ASSERT_TRUE(steps);
    EXPECT_EQ(steps->step, 32u);
    EXPECT_EQ(steps->gap, 96u);
}

TEST(TimestampSteps, AreAbsentWhereStampsDoNotAdvance) {
    EXPECT_FALSE(timestampSteps(std::array<std::uint64_t, 3>{7, 7, 7}));
    EXPECT_FALSE(timestampSteps(std::span<const std::uint64_t>()));
}

using TimestampStepsTest = GpuTest;

TEST_F(TimestampStepsTest, OfTheDeviceDivideItsGap) {
    const auto steps = timestampSteps(device());
    if (!steps) GTEST_SKIP() << "the device has no timestamps";
    EXPECT_GE(steps->step, 1u);
    EXPECT_EQ(steps->gap % steps->step, 0u);
}

}  // namespace
}  // namespace benchmarks::doctor
