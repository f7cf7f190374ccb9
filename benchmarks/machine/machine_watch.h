#pragma once

#include <memory>
#include <vector>

#include "benchmarks/machine/clock_source.h"
#include "benchmarks/report.h"
#include "engine/device.h"

namespace benchmarks {

// A round whose shader clock is below this share of the base clock is left out (nvbench's rule).
inline constexpr double kThrottledShare = 0.75;

// What went on in a round; what is not known is absent.
bool isThrottled(const Conditions& round);

// Medians of all rounds' numbers, and every throttle reason.
Conditions medianConditions(const std::vector<Conditions>& rounds);

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
    Conditions end();

private:
    struct Sources;
    std::unique_ptr<Sources> sources_;
};

}  // namespace benchmarks
