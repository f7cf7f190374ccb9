#pragma once

#include "benchmarks/measure/round_player.h"
#include "benchmarks/report.h"

namespace benchmarks {

// Plays a frame, untimed and without busy work, with pipeline statistics of the strands, and holds
// them against the counts that follow from the settings. Nothing where the device has none.
void addStatistics(const Play& play, CaseResult& result);

// The same of a frame that was played so: Timing::statistics. Nothing where it has no strands.
void addStatistics(
    const engine::FrameRecord& frame, const engine::Device& device, const Case& test_case,
    CaseResult& result);

// What blended fragments took and how many lists had no room for, of the last frame that was
// played.
void addTransparency(const Case& test_case, CaseResult& result);

}  // namespace benchmarks
