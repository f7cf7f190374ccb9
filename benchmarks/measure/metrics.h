#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/measure/sampling.h"
#include "benchmarks/report/report.h"
#include "engine/device.h"
#include "engine/frame_loop.h"

// Metrics, statistics and counts of a case, from its frames.
namespace benchmarks::measure {

// Plays isolated frames and frames whose passes are submitted and waited for one at a time, in
// turns, and returns what timestampFaults() (trust.h) finds. `play_frame` plays one frame. A fault
// of the device stays, a disturbance passes: while there are faults more pairs are played, up to
// 16.
std::vector<std::string> checkTimestamps(
    const engine::Device& device, const std::function<void(engine::FrameLoop&)>& play_frame);

// Plays a frame, untimed and without busy work, with pipeline statistics of the strands, and holds
// them against the counts that follow from the settings. Nothing where the device has none.
void addStatistics(const Play& play, report::CaseResult& result);

// Adds the statistics of a frame that was played with Timing::statistics. Nothing where it has no
// strands.
void addStatistics(
    const engine::FrameRecord& frame, const engine::Device& device, const Case& test_case,
    report::CaseResult& result);

// What blended fragments took and how many lists had no room for, of the last frame that was
// played.
void addTransparency(const Case& test_case, report::CaseResult& result);

// The metrics that frames of each mode give; docs/measuring.md says what each is.

// Fewest frames of which a share of `fraction` is one frame: with fewer, all three lows would be
// the slowest frame's rate.
std::size_t fewestForLow(double fraction);

// fps, fps.low_*, frame.time, frame.device.time, cpu.*.time, gpu.wait.time.
void addOverlappedMetrics(std::span<const engine::FrameRecord> frames, report::CaseResult& result);

// frame.isolated.time.
void addIsolatedMetrics(std::span<const engine::FrameRecord> frames, report::CaseResult& result);

// pass.*.time, in the mode that they were timed in.
void addPassTimes(
    std::span<const engine::FrameRecord> frames, report::Mode mode, report::CaseResult& result);

// trust.pass_sum_over_wall, and a warning where it is too far from 1.
void addPassSum(std::span<const engine::FrameRecord> isolated, report::CaseResult& result);

// What whole frames used of the CPU, by the isolated frames: frame.cpu.time and, where
// instructions are counted, frame.instructions.
void addFrameUse(std::span<const engine::FrameRecord> isolated, report::CaseResult& result);

// What passes used of the CPU, by the wall-clock frames: pass.*.cpu.time, pass.*.instructions.
void addPassUse(std::span<const engine::FrameRecord> wall_clock, report::CaseResult& result);

// What a buffer or image of this name is for: "simulation", "groom", "targets", ...; "other" if its
// name is in no row of the table.
std::string_view memoryPurpose(std::string_view name);

// Device memory, B, each with one sample: "memory.heap.<index>" for each heap that holds something
// and "memory.purpose.<purpose>" for each purpose that does. Both add up to all that is allocated.
std::vector<report::Metric> memoryMetrics(const engine::MemoryLedger& ledger);

}  // namespace benchmarks::measure
