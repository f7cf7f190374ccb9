#pragma once

#include <span>

#include "benchmarks/report.h"
#include "engine/frame_loop.h"

// The metrics that frames of each mode give; docs/measuring.md says what each is.
namespace benchmarks {

// Fewest frames of which a share of `fraction` is one frame: with fewer, all three lows would be
// the slowest frame's rate.
std::size_t fewestForLow(double fraction);

// fps, fps.low_*, frame.time, frame.device.time, cpu.*.time, gpu.wait.time.
void addOverlappedMetrics(std::span<const engine::FrameRecord> frames, CaseResult& result);

// frame.isolated.time.
void addIsolatedMetrics(std::span<const engine::FrameRecord> frames, CaseResult& result);

// pass.*.time, in the mode that they were timed in.
void addPassTimes(std::span<const engine::FrameRecord> frames, Mode mode, CaseResult& result);

// trust.pass_sum_over_wall, and a warning where it is too far from 1.
void addPassSum(std::span<const engine::FrameRecord> isolated, CaseResult& result);

// What whole frames used of the CPU, by the isolated frames: frame.cpu.time and, where
// instructions are counted, frame.instructions.
void addFrameUse(std::span<const engine::FrameRecord> isolated, CaseResult& result);

// The same of passes, by the wall-clock frames: pass.*.cpu.time, pass.*.instructions.
void addPassUse(std::span<const engine::FrameRecord> wall_clock, CaseResult& result);

}  // namespace benchmarks
