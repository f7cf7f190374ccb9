#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/measure/measure.h"
#include "benchmarks/measure/trust.h"
#include "benchmarks/report/report.h"
#include "engine/device.h"
#include "engine/system/machine.h"
#include "hair/groom/groom.h"
#include "hair/settings.h"

// A small scene that needs only the file that it writes itself: a mop of hair in a gusty wind. A
// frame takes milliseconds on a software device and has every pass of the thesis's frame.

namespace benchmarks::doctor {

// The scene's settings. /groom/file is kDoctorStrands, relative to the folder that
// writeDoctorScene() fills.
hair::Settings doctorSettings();

inline constexpr const char* kDoctorStrands = "doctor.hair";

// The guides in kDoctorStrands: they hang from a disc, arranged like a sunflower's seeds.
hair::groom::StrandSet doctorStrands();

// Writes the strands and the scene, "doctor.json", into an existing folder. Returns the scene's
// path. Throws engine::Error.
std::filesystem::path writeDoctorScene(const std::filesystem::path& folder);

// These play the doctor's scene. They throw Interrupted if the hooks request it.

// How times of passes add up in the doctor's scene.
struct PassFacts {
    measure::PassSum sum;  // of isolated passes
    std::vector<std::string> faults;  // of timestamps against submit-and-wait
};

// Two cases of equal settings, played in turns.
struct RepeatFacts {
    bool same_picture = false;
    bool same_state = false;
    std::vector<double> frame;  // [pair], ln(B/A) of the median frame time
    std::vector<double> cpu;    // [pair], ln(B/A) of the process's CPU time
};

// How the passes add up, and whether timestamps say what the CPU's clock does.
PassFacts examinePasses(const engine::Device& device, const measure::MeasureHooks& hooks);

// Alternates two cases with the same settings, A B, B A, A B ..., so that a drift of the machine
// raises as many differences as it lowers. It plays 12 pairs of rounds, which all have the same
// frames.
RepeatFacts examineRepeat(const engine::Device& device, const measure::MeasureHooks& hooks);

// The facts that the doctor judges. Unknown facts are absent.

struct TimestampFacts {
    std::uint32_t valid_bits = 0;  // 0: the device has no timestamps
    double period_ns = 0.0;        // of a tick, as reported by the driver
    std::optional<double> step_ns;  // all differences of timestamps are multiples of this
    std::optional<double> gap_ns;   // smallest difference between adjacent timestamps
};

struct ClockFacts {
    std::optional<double> lowest_mhz;  // of the shaders, while frames were drawn
    std::optional<double> highest_mhz;
    bool held = false;  // an administrator set the clocks
    bool taken_for_idle = false;  // the driver always reported idle, whatever was drawn, so the
                                  // clocks are unknown
    report::Conditions conditions;
};

struct ProcessorFacts {
    std::vector<std::string> governors;  // of frequency scaling, without repetition
    std::optional<std::uint32_t> count;
    std::optional<double> quota;  // processor time that this process may use, in processors
};

struct LoadFacts {
    std::optional<double> steal;  // shares of all processors' time
    std::optional<double> others;
};

struct LayerFacts {
    bool validation = false;          // this program's own validation
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
    std::optional<ClockFacts> clocks;  // absent if there is no clock source
    ProcessorFacts processor;
    LoadFacts load;
    std::optional<bool> on_battery;
};

// Gathers all facts: watches the idle machine for a second, then plays the doctor's scene for some
// seconds. Throws Interrupted if the hooks request it.
Facts gatherFacts(
    const engine::Device& device, engine::Validation validation,
    const measure::MeasureHooks& hooks);

// True if the path's file name is that of a Vulkan layer's library.
bool isLayerLibrary(std::string_view path);

// File names of the Vulkan layers in this process, explicit and implicit. The loader does not
// report the active ones, but it loads only their libraries.
std::vector<std::string> loadedLayers();

using engine::system::onBattery;
using engine::system::processorQuota;
using engine::system::scalingGovernors;

// Resolution of timestamps, in ticks.
struct TimestampSteps {
    std::uint64_t step = 0;  // all differences are multiples of this; the counter may advance by
                             // more than a tick
    std::uint64_t gap = 0;  // smallest difference between successive different timestamps: the
                            // apparent duration of an empty pass
};

// Resolution from timestamps in the order in which they were taken; absent if none differ.
std::optional<TimestampSteps> timestampSteps(std::span<const std::uint64_t> ticks);

// Resolution of the device's timestamps, from timestamps with nothing between them.
std::optional<TimestampSteps> timestampSteps(const engine::Device& device);

}  // namespace benchmarks::doctor
