#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/measure/case.h"
#include "benchmarks/report/report.h"
#include "engine/process.h"

// Measures one case.
namespace benchmarks::measure {

// How far a mode of a case is, for who waits.
struct SamplingState {
    std::string mode;
    std::uint32_t rounds = 0;
    double median = 0.0;                    // ms, of the frames so far
    std::optional<double> relative_half_width;  // of its 95 % interval; absent: too few samples
    double seconds = 0.0;                   // since the mode began
    double max_seconds = 0.0;               // when its last round begins at the latest
};

struct MeasureHooks {
    std::function<bool()> stop;  // asked between frames; true ends all with Interrupted
    std::function<void(const SamplingState&)> progress{};  // told after each round; may be empty
};

// Plays the case in rounds of /run/warmup and /run/frames frames, overlapped and then isolated,
// until the frame time is known to /run/precision or /run/max_time is over, checks that all made
// the same picture and state, holds the timestamps against the CPU's clock, and counts with
// pipeline statistics in a frame of its own. Fills in metrics, statistics, counts, sampling,
// conditions, trust and hashes of `result`. Returns the picture that is hashed, [row][column] RGBA,
// top row first: that of a round's last frame. Throws Interrupted where the user asks to stop,
// engine::Error if the device was throttled in all rounds or there is no /run/busy_pass.
std::vector<std::uint8_t> measure(
    const engine::Device& device, Case& test_case, const hair::RunSettings& run,
    const MeasureHooks& hooks, report::CaseResult& result);

}  // namespace benchmarks::measure
