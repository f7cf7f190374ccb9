#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
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

// What a run has learnt of its device, from case to case.
struct DeviceKnowledge {
    // MHz, the highest shader clock under full load, by /run/clocks.
    std::map<hair::Clocks, double> held_clock;
    // Names of the passes of frames whose timestamps were checked and are right.
    std::vector<std::vector<std::string>> trusted_passes;
    // Of frames of these passes, in how many of them planted work was found so far.
    std::map<std::vector<std::string>, std::size_t> checked_passes;
    std::uint32_t planted_steps = 0;  // of work that is looked for; 0: not known yet
    // Stage::timestampRate(), once it was asked for.
    std::optional<std::optional<double>> timestamp_rate;
};

struct MeasureHooks {
    std::function<bool()> stop;  // asked between frames; true ends all with Interrupted
    std::function<void(const SamplingState&)> progress{};  // told after each round; may be empty
    DeviceKnowledge* known = nullptr;  // of the run; null: each case learns for itself
};

// Plays the case in rounds of /run/warmup and /run/frames frames, overlapped and then isolated,
// until the frame time is known to /run/precision or /run/max_time is over, checks that all made
// the same picture and state, holds the timestamps against the CPU's clock, and counts with
// pipeline statistics in the frame that ends the first isolated round. Fills in metrics,
// statistics, counts, sampling, conditions, trust and hashes of `result`; its status is `failed`,
// and its samples those of throttled rounds, if the device was throttled in all rounds. Returns the
// picture that is hashed, [row][column] RGBA, top row first: that of a round's last frame. Throws
// Interrupted where the user asks to stop, engine::Error if there is no /run/busy_pass.
std::vector<std::uint8_t> measure(
    const engine::Device& device, Case& test_case, const hair::RunSettings& run,
    const MeasureHooks& hooks, report::CaseResult& result);

// What of it needs no case, on any stage: metrics of frames and passes, sampling, conditions, trust
// and hashes.
class Stage;
std::vector<std::uint8_t> measureFrames(
    Stage& stage, const hair::RunSettings& run, const MeasureHooks& hooks,
    report::CaseResult& result);

}  // namespace benchmarks::measure
