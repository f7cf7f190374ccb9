#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/report.h"

// What the doctor looked at, before anyone judges it. What could not be seen is absent.
namespace benchmarks {

struct TimestampFacts {
    std::uint32_t valid_bits = 0;  // 0: the device has no timestamps
    double period_ns = 0.0;        // of a tick, as the driver says
    std::optional<double> step_ns;  // that differences of stamps are multiples of
    std::optional<double> gap_ns;   // between two stamps with nothing between them, at least
};

// Of the doctor's scene.
struct PassFacts {
    double sum_over_wall = 0.0;       // isolated passes over the wall clock
    std::vector<std::string> faults;  // of timestamps against submit-and-wait
};

// The same case twice, in turns.
struct RepeatFacts {
    bool same_picture = false;
    bool same_state = false;
    std::vector<double> frame;  // [pair], ln(B/A) of the median frame time
    std::vector<double> cpu;    // [pair], ln(B/A) of the process's CPU time
};

struct ClockFacts {
    std::optional<double> lowest_mhz;  // of the shaders, while frames were drawn
    std::optional<double> highest_mhz;
    bool held = false;  // an administrator set them
    Conditions conditions;
};

struct ProcessorFacts {
    std::vector<std::string> governors;  // of frequency scaling, each once
    std::optional<std::uint32_t> count;
    std::optional<double> quota;  // processors' worth of time that this process may use
};

struct LoadFacts {
    std::optional<double> steal;  // shares of all processors' time
    std::optional<double> others;
};

struct LayerFacts {
    bool validation = false;          // this program's own
    std::vector<std::string> loaded;  // libraries of Vulkan layers in this process
};

struct BuildFacts {
    BuildRecord build;
    bool assertions = false;
};

struct Facts {
    DeviceRecord device;
    BuildFacts build;
    LayerFacts layers;
    TimestampFacts timestamps;
    PassFacts passes;
    RepeatFacts repeat;
    std::optional<ClockFacts> clocks;  // absent where nothing tells them
    ProcessorFacts processor;
    LoadFacts load;
    std::optional<bool> on_battery;
};

}  // namespace benchmarks
