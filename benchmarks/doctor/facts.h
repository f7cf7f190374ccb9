#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/doctor/play_pairs.h"
#include "benchmarks/measure/measure.h"
#include "benchmarks/report/report.h"
#include "engine/device.h"

// What the doctor looked at, before anyone judges it. What could not be seen is absent.
namespace benchmarks::doctor {

struct TimestampFacts {
    std::uint32_t valid_bits = 0;  // 0: the device has no timestamps
    double period_ns = 0.0;        // of a tick, as the driver says
    std::optional<double> step_ns;  // that differences of stamps are multiples of
    std::optional<double> gap_ns;   // between two stamps with nothing between them, at least
};

struct ClockFacts {
    std::optional<double> lowest_mhz;  // of the shaders, while frames were drawn
    std::optional<double> highest_mhz;
    bool held = false;  // an administrator set them
    bool taken_for_idle = false;  // by the driver, whatever was drawn, so that nothing is known
    report::Conditions conditions;
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
    report::BuildRecord build;
    bool assertions = false;
};

struct Facts {
    report::DeviceRecord device;
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

// Looks at everything: a second of the idle machine, then some seconds of the doctor's scene.
// Throws Interrupted where the hooks say so.
Facts gatherFacts(
    const engine::Device& device, engine::Validation validation,
    const measure::MeasureHooks& hooks);

// Whether a library of this path is a Vulkan layer, by the names that layers' libraries have.
bool isLayerLibrary(std::string_view path);

// File names of the Vulkan layers in this process, explicit and implicit: the loader does not tell
// which are active, but it loads the libraries of those alone.
std::vector<std::string> loadedLayers();

// What Linux tells of how processors are run. `root` is where its file systems are.

// Governors of frequency scaling of all processors, each once, sorted; empty where there is none,
// as in most virtual machines.
std::vector<std::string> scalingGovernors(const std::filesystem::path& root = "/");

// How many processors' worth of time the control group may use; absent where there is no limit.
std::optional<double> processorQuota(const std::filesystem::path& root = "/");

// Whether the machine runs on its battery; absent where no power supply tells.
std::optional<bool> onBattery(const std::filesystem::path& root = "/");

// How finely stamps divide time, in ticks.
struct TimestampSteps {
    std::uint64_t step = 0;  // that all differences are multiples of: the counter may advance by
                             // more than a tick
    std::uint64_t gap = 0;  // smallest difference between successive stamps that differ: what an
                            // empty pass would seem to take
};

// Steps of stamps in the order in which they were taken; absent where none differ.
std::optional<TimestampSteps> timestampSteps(std::span<const std::uint64_t> ticks);

// Steps of the device's timestamps, taken one after another with nothing between them.
std::optional<TimestampSteps> timestampSteps(const engine::Device& device);

}  // namespace benchmarks::doctor
