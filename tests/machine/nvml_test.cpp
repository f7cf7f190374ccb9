#include "benchmarks/measure/clocks.h"

#include <stdexcept>

#include <dlfcn.h>
#include <gmock/gmock.h>

extern "C" {
#include "tests/machine/fake_nvml.h"
}

namespace benchmarks::measure {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr PciAddress kNvidiaAddress{.domain = 0, .bus = 0x65, .device = 0, .function = 0};
constexpr int kNotSupported = 3;  // NVML_ERROR_NOT_SUPPORTED
constexpr int kUnknown = 999;     // NVML_ERROR_UNKNOWN

// A fake library in a healthy state, with its answers.
class Fake {
public:
    explicit Fake(const char* path) : path_(path), library_(dlopen(path, RTLD_NOW)) {
        if (!library_) throw std::runtime_error(dlerror());
        state_ = static_cast<FakeNvml*>(dlsym(library_, "fakeNvml"));
        *state_ = {};
        state_->clock = 1500;
        state_->memory_clock = 2619;
        state_->applications_clock = 1980;
        state_->greatest_clock = 2100;
        state_->temperature = 41;
    }
    Fake(const Fake&) = delete;
    Fake& operator=(const Fake&) = delete;
    ~Fake() { dlclose(library_); }

    FakeNvml* operator->() const { return state_; }
    std::unique_ptr<ClockSource> open() const { return openNvml(kNvidiaAddress, path_); }
    ClockReading read() const { return open()->read(); }

private:
    const char* path_;
    void* library_;
    FakeNvml* state_;
};

TEST(Nvml, IsAbsentWithoutItsLibrary) {
    EXPECT_EQ(openNvml(kNvidiaAddress, "libhairbench-no-such-library.so.1"), nullptr);
}

TEST(Nvml, IsAbsentIfALibraryOfThatNameIsSomethingElse) {
    EXPECT_EQ(openNvml(kNvidiaAddress, "libc.so.6"), nullptr);
}

TEST(Nvml, IsAbsentWithoutADriver) {
    const Fake fake(FAKE_NVML);
    fake->init_result = 9;  // NVML_ERROR_DRIVER_NOT_LOADED
    EXPECT_EQ(fake.open(), nullptr);
    EXPECT_EQ(fake->users, 0);
}

TEST(Nvml, IsAbsentForADeviceThatItDoesNotKnow) {
    const Fake fake(FAKE_NVML);
    fake->handle_result = 6;  // NVML_ERROR_NOT_FOUND
    EXPECT_EQ(fake.open(), nullptr);
    EXPECT_EQ(fake->users, 0);
}

TEST(Nvml, AsksForTheDeviceByItsAddressAndShutsDown) {
    const Fake fake(FAKE_NVML);
    {
        const auto nvml = fake.open();
        ASSERT_NE(nvml, nullptr);
        EXPECT_STREQ(fake->address, "0000:65:00.0");
        EXPECT_EQ(fake->users, 1);
    }
    EXPECT_EQ(fake->users, 0);
}

TEST(Nvml, ReadsClocksAndTemperature) {
    const Fake fake(FAKE_NVML);
    const ClockReading reading = fake.read();
    EXPECT_EQ(reading.clock_mhz, 1500.0);
    EXPECT_EQ(reading.memory_clock_mhz, 2619.0);
    EXPECT_EQ(reading.base_clock_mhz, 1980.0);
    EXPECT_EQ(reading.temperature, 41.0);
    EXPECT_FALSE(reading.idle);
    EXPECT_FALSE(reading.held);
    EXPECT_THAT(reading.throttle_reasons, IsEmpty());
}

TEST(Nvml, ReadsPowerAndLoad) {
    const Fake fake(FAKE_NVML);
    fake->milliwatts = 431500;
    fake->load = 93;
    EXPECT_DOUBLE_EQ(fake.read().power_w.value(), 431.5);
    EXPECT_DOUBLE_EQ(fake.read().load.value(), 0.93);
    EXPECT_EQ(fake.read().load_lag, 1.0);  // s: a sample period is 1/6 s to 1 s
    fake->clock_result = kNotSupported;
    EXPECT_EQ(fake.read().power_w, std::nullopt);
    EXPECT_EQ(fake.read().load, std::nullopt);
}

TEST(Nvml, ReadsTheEnergyCounterWhereThereIsOne) {
    const Fake fake(FAKE_NVML);
    fake->millijoules = 5'000'000'000'123;  // more than 32 bits
    EXPECT_DOUBLE_EQ(fake.open()->energy().value(), 5'000'000'000.123);
    fake->energy_result = kNotSupported;  // before Volta
    EXPECT_EQ(fake.open()->energy(), std::nullopt);
    EXPECT_EQ(Fake(FAKE_NVML_BARE).open()->energy(), std::nullopt);
}

TEST(Nvml, ReadsThePowerLimit) {
    for (const char* library : {FAKE_NVML, FAKE_NVML_OLD}) {
        const Fake fake(library);
        fake->power_limit = 262500;
        EXPECT_DOUBLE_EQ(fake.open()->powerLimit().value(), 262.5);
        fake->clock_result = kNotSupported;
        EXPECT_EQ(fake.open()->powerLimit(), std::nullopt);
    }
    EXPECT_EQ(Fake(FAKE_NVML_BARE).open()->powerLimit(), std::nullopt);
}

TEST(Nvml, TakesTheGreatestClockAsBaseOfABoardWithoutApplicationsClock) {
    const Fake fake(FAKE_NVML);
    fake->applications_clock_result = kNotSupported;
    EXPECT_EQ(fake.read().base_clock_mhz, 2100.0);
}

TEST(Nvml, NamesThrottleReasons) {
    const Fake fake(FAKE_NVML);
    fake->reasons = 0x4 | 0x40;  // nvmlClocksEventReasonSwPowerCap, HwThermalSlowdown
    EXPECT_THAT(
        fake.read().throttle_reasons, ElementsAre("power cap", "hardware thermal slowdown"));
}

TEST(Nvml, KnowsAnIdleDevice) {
    const Fake fake(FAKE_NVML);
    fake->reasons = 0x1;  // nvmlClocksEventReasonGpuIdle
    const ClockReading reading = fake.read();
    EXPECT_TRUE(reading.idle);
    EXPECT_THAT(reading.throttle_reasons, IsEmpty());
}

TEST(Nvml, HoldsNoClockAgainstAnAdministratorsChoice) {
    const Fake fake(FAKE_NVML);
    fake->reasons = 0x2;  // nvmlClocksEventReasonApplicationsClocksSetting
    const ClockReading reading = fake.read();
    EXPECT_TRUE(reading.held);
    EXPECT_EQ(reading.clock_mhz, 1500.0);
    EXPECT_EQ(reading.base_clock_mhz, std::nullopt);
    EXPECT_THAT(reading.throttle_reasons, IsEmpty());
}

TEST(Nvml, LeavesOutWhatFails) {
    const Fake fake(FAKE_NVML);
    fake->clock_result = kUnknown;
    fake->reasons_result = kNotSupported;
    fake->reasons = 0x4;
    const ClockReading reading = fake.read();
    EXPECT_EQ(reading.clock_mhz, std::nullopt);
    EXPECT_EQ(reading.memory_clock_mhz, std::nullopt);
    EXPECT_THAT(reading.throttle_reasons, IsEmpty());
    EXPECT_EQ(reading.base_clock_mhz, 1980.0);
    EXPECT_EQ(reading.temperature, 41.0);
}

TEST(Nvml, TakesAClockOfZeroForUnknown) {
    const Fake fake(FAKE_NVML);
    fake->clock = 0;
    EXPECT_EQ(fake.read().clock_mhz, std::nullopt);
}

TEST(Nvml, KnowsTheOlderNameOfThrottleReasons) {
    const Fake fake(FAKE_NVML_OLD);
    fake->reasons = 0x80;  // nvmlClocksThrottleReasonHwPowerBrakeSlowdown
    const ClockReading reading = fake.read();
    EXPECT_THAT(reading.throttle_reasons, ElementsAre("power brake"));
    EXPECT_EQ(reading.base_clock_mhz, 2100.0);
}

TEST(Nvml, SaysNothingWhereEveryFunctionIsMissing) {
    const Fake fake(FAKE_NVML_BARE);
    const ClockReading reading = fake.read();
    EXPECT_EQ(reading.clock_mhz, std::nullopt);
    EXPECT_EQ(reading.base_clock_mhz, std::nullopt);
    EXPECT_EQ(reading.memory_clock_mhz, std::nullopt);
    EXPECT_EQ(reading.temperature, std::nullopt);
    EXPECT_FALSE(reading.idle);
}

// In nvml.h NVML_CLOCK_LIMIT_ID_RANGE_START is 0xffffff00, and NVML_CLOCK_LIMIT_ID_TDP is the next
// value.
TEST(Nvml, LocksAtTheDesignPowersClockUntilItGoes) {
    const Fake fake(FAKE_NVML);
    {
        const auto source = fake.open();
        ASSERT_TRUE(source->lock());
        EXPECT_EQ(fake->locked_least, 0xffffff01u);
        EXPECT_EQ(fake->locked_most, 0xffffff01u);
    }
    EXPECT_EQ(fake->locked_most, 0u);
}

TEST(Nvml, LocksNothingForAUserWhoMayNot) {
    const Fake fake(FAKE_NVML);
    fake->locked_least = fake->locked_most = 1410;  // set by an administrator
    fake->lock_result = 4;  // NVML_ERROR_NO_PERMISSION
    {
        const auto source = fake.open();
        EXPECT_FALSE(source->lock());
        EXPECT_EQ(source->lockCommand(), "nvidia-smi --id=0000:65:00.0 --lock-gpu-clocks=MHZ");
    }
    EXPECT_EQ(fake->locked_most, 1410u);
    EXPECT_FALSE(Fake(FAKE_NVML_BARE).open()->lock());
}

}  // namespace
}  // namespace benchmarks::measure
