#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "benchmarks/case.h"
#include "benchmarks/interrupt.h"
#include "benchmarks/report.h"

namespace benchmarks {

// Asked between frames; true ends the measurement with Interrupted.
using StopRequest = std::function<bool()>;

// Plays the case from its first frame once overlapped and once isolated, each with /run/warmup
// frames of warm-up and /run/frames measured ones, checks that both made the same picture and
// state, holds the timestamps against the CPU's clock, and counts with pipeline statistics in a
// frame of its own. Fills in metrics, statistics, counts, trust and hashes of `result`. Returns the
// picture that is hashed, [row][column] RGBA, top row first: that of the last measured frame.
std::vector<std::uint8_t> measure(
    const engine::Device& device, Case& test_case, const hair::RunSettings& run,
    const StopRequest& stop, CaseResult& result);

}  // namespace benchmarks
