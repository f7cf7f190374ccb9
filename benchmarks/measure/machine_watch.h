#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "benchmarks/measure/clocks.h"
#include "benchmarks/report/report.h"
#include "engine/device.h"

// Conditions of a measurement: clocks, throttling, steal time, load by other processes.
namespace benchmarks::measure {

// Reads a clock source again and again while a round is played: before and after it the device is
// idle, and its clocks with it. A reading takes some tens of microseconds of one processor, in a
// thread that sleeps otherwise.
class ClockSampler {
public:
    explicit ClockSampler(std::unique_ptr<ClockSource> source);
    ~ClockSampler();
    ClockSampler(const ClockSampler&) = delete;
    ClockSampler& operator=(const ClockSampler&) = delete;

    void begin();
    // One reading at least: that at the end.
    std::vector<ClockReading> end();

private:
    void sampleUntilStopped();

    std::unique_ptr<ClockSource> source_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool running_ = false;
    bool stopped_ = false;
    std::vector<ClockReading> readings_;
    std::thread thread_;
};

// Medians of what the readings know, of those that were not taken of an idle device if there are
// such; every throttle reason of theirs, each once.
void addClocks(const std::vector<ClockReading>& readings, report::Conditions& conditions);

// A round whose shader clock is below this share of the base clock is left out (nvbench's rule).
inline constexpr double kThrottledShare = 0.75;

// What went on in a round; what is not known is absent.
bool isThrottled(const report::Conditions& round);

// Medians of all rounds' numbers, and every throttle reason.
report::Conditions medianConditions(const std::vector<report::Conditions>& rounds);

// What tells this device's clocks: NVML (NVIDIA) or sysfs (amdgpu). Null on a software device, and
// where nothing tells them.
std::unique_ptr<ClockSource> openClockSource(const engine::DeviceInfo& device);

// Watches the machine while rounds are played: the device's clocks where something tells them, and
// steal time and what other processes use of the processors (/proc/stat), which on a software
// device is what the frames are made with and on others what records them. Never changes a setting.
class MachineWatch {
public:
    explicit MachineWatch(const engine::Device& device);
    ~MachineWatch();
    MachineWatch(const MachineWatch&) = delete;
    MachineWatch& operator=(const MachineWatch&) = delete;

    void begin();
    // Since begin().
    report::Conditions end();

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
