#pragma once

#include "benchmarks/machine/machine_watch.h"
#include "benchmarks/measure/round_player.h"
#include "benchmarks/measure/sample_rounds.h"

namespace benchmarks {

// A mode of a case, sampled.
struct SampledMode : SampledRounds {
    double first_frame = 0.0;  // ms, from recording to completion, of the mode's first
    RoundEnd end;              // of the last round
};

// The rule of a mode by a scene's settings: the overlapped mode is judged by its intervals, the
// others by their wall clock.
SamplingRule samplingRule(engine::Timing timing, const hair::RunSettings& run);

// Plays the mode's rounds; enters its sampling, and warns in `result` if its first and last rounds
// made different pictures or states. An unknown /run/busy_pass is an engine::Error.
SampledMode sampleMode(
    const Play& play, engine::Timing timing, const SamplingRule& rule, MachineWatch& watch,
    CaseResult& result);

}  // namespace benchmarks
