#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "benchmarks/measure/case.h"
#include "benchmarks/measure/stage.h"
#include "benchmarks/report/report.h"
#include "engine/process.h"

// Measures one case.
namespace benchmarks::measure {

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
std::vector<std::uint8_t> measureFrames(
    Stage& stage, const hair::RunSettings& run, const MeasureHooks& hooks,
    report::CaseResult& result);

}  // namespace benchmarks::measure
