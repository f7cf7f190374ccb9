#pragma once

#include <optional>
#include <string>
#include <vector>

namespace benchmarks {

// What a device says of its clocks at one moment; what it does not say is absent.
struct ClockReading {
    std::optional<double> clock_mhz;  // of the shaders
    // What the shaders are meant to run at; absent where they are held at an administrator's choice
    // too: there is nothing then to hold a slow clock against.
    std::optional<double> base_clock_mhz;
    std::optional<double> memory_clock_mhz;
    std::optional<double> temperature;  // degrees Celsius
    bool idle = false;  // nothing ran just then: its clocks say nothing of a measurement
    bool held = false;  // an administrator set the clocks
    std::vector<std::string> throttle_reasons;  // why the clocks are lower than they might be
};

// A driver's way of telling clocks. Only reads: no setting is ever changed.
class ClockSource {
public:
    virtual ~ClockSource() = default;
    virtual ClockReading read() = 0;
};

}  // namespace benchmarks
