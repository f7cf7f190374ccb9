#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>
#include <vector>

#include "benchmarks/measure/clocks.h"
#include "benchmarks/report/report.h"
#include "engine/device.h"
#include "hair/settings.h"

// Conditions of a measurement: clocks, throttling, steal time, load by other processes.
namespace benchmarks::measure {

// Reads a clock source again and again while frames are played: before and after the device is
// idle, and its clocks with it. A reading takes some tens of microseconds of one processor, in a
// thread that sleeps otherwise.
class ClockSampler {
public:
    explicit ClockSampler(std::unique_ptr<ClockSource> source);
    ~ClockSampler();
    ClockSampler(const ClockSampler&) = delete;
    ClockSampler& operator=(const ClockSampler&) = delete;

    // From now on, and anew. The first reading is one period away: the device has work by then.
    void begin();
    // The readings since begin() or the last take(), of that time alone. Takes none itself.
    std::vector<ClockReading> take();

private:
    void sampleUntilStopped();

    std::unique_ptr<ClockSource> source_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool running_ = false;
    bool restarted_ = false;
    bool stopped_ = false;
    std::vector<ClockReading> readings_;
    std::chrono::steady_clock::time_point since_;  // what the readings may tell of
    std::thread thread_;
};

// A device that had work for less of the time than this was idle.
inline constexpr double kIdleLoad = 0.2;

// Those of a device at work; others tell nothing. Where the driver calls the device idle in all of
// them, those whose load says otherwise.
std::vector<ClockReading> readingsAtWork(const std::vector<ClockReading>& readings);

// Medians of what the readings know that were taken at work, the lowest clock among them, and every
// throttle reason of theirs, each once.
void addClocks(const std::vector<ClockReading>& readings, report::Conditions& conditions);

// Whether a driver's throttle reason is heat or power; others, as a clock that somebody set, are no
// throttling.
bool isHeatOrPower(std::string_view reason);

// Whether the device says that it had hardly a moment without work.
bool isFullyLoaded(const report::Conditions& round);

// Rounds of one mode give the device the same work, so a clock below this share of what it held in
// another is held back.
inline constexpr double kHeldShare = 0.9;
// Other cases may draw more power and hold another clock: below this share of what the device held
// in any of them, under full load, it is held back (nvbench's share).
inline constexpr double kThrottledShare = 0.75;

// A board at its power limit is at work as it is meant to be while its clock is steady: with that
// reason a clock below this share of what it held is held back.
inline constexpr double kCappedShare = 0.97;

// Whether heat or power held the device back in a round: its driver says so, or its lowest clock
// under load does. `held` is the highest clock of the mode's rounds, `held_before` that of other
// cases of the run, MHz; 0: unknown. The board's base clock is no measure: locked clocks may be
// below it.
bool isThrottled(const report::Conditions& round, double held, double held_before);

// Medians of all rounds' numbers, and every throttle reason.
report::Conditions medianConditions(const std::vector<report::Conditions>& rounds);

// What tells this device's clocks: NVML (NVIDIA) or sysfs (amdgpu). Null on a software device, and
// where nothing tells them.
std::unique_ptr<ClockSource> openClockSource(const engine::DeviceInfo& device);

// Clocks as /run/clocks asks for, until it goes. Throws engine::Unsupported, with what to do about
// it, where they can't be had: on a software device, where nothing tells the device's clocks, where
// the user may not lock them, and for free ones where an administrator holds them.
class ClockHold {
public:
    ClockHold(const engine::DeviceInfo& device, hair::Clocks clocks);
    // `source` null: nothing tells the device's clocks.
    ClockHold(
        const engine::DeviceInfo& device, hair::Clocks clocks, std::unique_ptr<ClockSource> source);

private:
    std::unique_ptr<ClockSource> source_;  // unlocks at its end
};

// Watches the machine while rounds are played: the device's clocks where something tells them, and
// steal time and what other processes use of the processors (/proc/stat), which on a software
// device is what the frames are made with and on others what records them. Changes no setting.
class MachineWatch {
public:
    explicit MachineWatch(const engine::Device& device);
    ~MachineWatch();
    MachineWatch(const MachineWatch&) = delete;
    MachineWatch& operator=(const MachineWatch&) = delete;

    void begin();
    // Since begin() or the last take().
    report::Conditions take();

private:
    struct Sources;
    std::unique_ptr<Sources> sources_;
};

// What all processors did since the machine started, in ticks (of 10 ms on most machines), by the
// first line of Linux's /proc/stat (proc_stat(5)).
struct ProcessorTicks {
    std::uint64_t busy = 0;  // in processes and in the kernel
    std::uint64_t steal = 0;  // that a hypervisor gave to others
    std::uint64_t total = 0;  // with what was idle
};

// Absent where there is no such file or it is not understood.
std::optional<ProcessorTicks> readProcessorTicks(const std::filesystem::path& path = "/proc/stat");

// What a package of processors has used since some moment (Linux, powercap's intel-rapl; often for
// the administrator alone to read).
struct EnergyCounter {
    std::uint64_t microjoules = 0;
    std::uint64_t range = 0;  // at which it begins anew
};

// Of every package; none where they can't be read.
std::vector<EnergyCounter>
readEnergyCounters(const std::filesystem::path& folder = "/sys/class/powercap");

// J; absent where one of them is unknown. Counters may have begun anew once.
std::optional<double>
joulesBetween(const std::vector<EnergyCounter>& before, const std::vector<EnergyCounter>& after);

// Shares of all processors' time.
struct ProcessorLoad {
    double steal = 0.0;
    double others = 0.0;  // what other processes used; ticks are coarse, so it is cut off at 0
};

// Between two readings, in which this process used `own` ms of processor time. Absent where no tick
// passed.
std::optional<ProcessorLoad>
loadBetween(const ProcessorTicks& before, const ProcessorTicks& after, double own);

}  // namespace benchmarks::measure
