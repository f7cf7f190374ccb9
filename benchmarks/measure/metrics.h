#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/measure/case.h"
#include "benchmarks/report/report.h"
#include "engine/device.h"
#include "engine/frame_loop.h"

// Metrics, statistics and counts of a case, from its frames.
namespace benchmarks::measure {

// ---- Passes of frames ---------------------------------------------------------------------------

// The names of all passes, in the order of their first appearance: not every frame runs every pass.
std::vector<std::string> passNames(std::span<const engine::FrameRecord> frames);

// The times of one pass in the frames that ran it, ms.
std::vector<double> passTimes(std::span<const engine::FrameRecord> frames, const std::string& pass);

// The sum of a frame's pass times, ms.
double passSum(const engine::FrameRecord& frame);

// Median over frames of (sum of the passes / wall clock from submission to completion). 1 if the
// passes are all of the frame, the timestamps are right, and submitting takes no time.
double passSumOverWall(std::span<const engine::FrameRecord> isolated);

// Time for submission and waiting in addition to the work, from isolated frames with known work or
// without work.
struct EmptySubmission {
    double median = 0.0;  // ms
    double spread = 0.0;  // ms, from the median to the 95th percentile
};
EmptySubmission emptySubmission(std::span<const engine::FrameRecord> empty);

// The sum of the passes of isolated frames, compared with two independent clocks. Each ratio is a
// median over frames, and absent if the frames have no timestamps.
struct PassSum {
    std::optional<double> over_wall;
    std::optional<double> over_device;  // over the device's own time from the first to the last
                                        // timestamp
    std::optional<double> over_work;  // over the wall clock less the time of a submission
    // Whether the passes do not make up the whole frame: they differ from the device's time by more
    // than report::kTrustTolerance, or from the wall clock by more than that and the variation of
    // submissions.
    bool incomplete = false;
};
PassSum passSums(std::span<const engine::FrameRecord> isolated, const EmptySubmission& empty);

// ---- Metrics of a case --------------------------------------------------------------------------

// Returns what a count should have been, "expected 120" or "expected at least 120"; none if it is
// right, or if nothing is expected. A GPU may run the stages that make vertices more than once for
// a vertex, for example if batches of a patch's vertices share some, but never less often. A
// processor runs them once. Counts that follow from primitives are exact everywhere. `statistic` is
// one of engine::kStatisticNames.
std::optional<std::string> missedCount(
    std::string_view statistic, std::uint64_t measured, std::optional<std::uint64_t> expected,
    const engine::DeviceInfo& device);

// Adds the statistics of the pass "strands" of a frame played with Timing::statistics, and compares
// them with the counts expected from the settings. Does nothing for a frame without strands.
void addStatistics(
    const engine::FrameRecord& frame, const engine::Device& device, const Case& test_case,
    report::CaseResult& result);

// Adds the statistics of the other passes as "<pass>.<statistic>", summed over passes of one name.
// Nothing is expected of them. Counts of 0 are left out.
void addPassStatistics(
    const engine::FrameRecord& frame, const engine::Device& device, report::CaseResult& result);

// Adds the memory of blended fragments and the number that did not fit the lists, for the last
// frame.
void addTransparency(const Case& test_case, report::CaseResult& result);

// The metrics from frames of each mode; docs/measuring.md defines them.

// Smallest number of frames in which a share of `fraction` is one frame. With fewer, all three lows
// would be the slowest frame's rate.
std::size_t fewestForLow(double fraction);

// fps, fps.low_*, fps.device_low_*, frame.time, frame.device.time, cpu.*.time, gpu.wait.time.
void addOverlappedMetrics(std::span<const engine::FrameRecord> frames, report::CaseResult& result);

// frame.isolated.time.
void addIsolatedMetrics(std::span<const engine::FrameRecord> frames, report::CaseResult& result);

// pass.*.time, in the mode in which they were timed.
void addPassTimes(
    std::span<const engine::FrameRecord> frames, report::Mode mode, report::CaseResult& result);

// frame.cycles and pass.*.cycles: the device's times of overlapped frames and of isolated passes,
// in cycles of its shaders' clock in those rounds. Adds nothing if the clock is unknown. If the
// time changes but the cycles do not, the clock has changed.
void addCycles(
    std::span<const engine::FrameRecord> overlapped, std::optional<double> overlapped_mhz,
    std::span<const engine::FrameRecord> isolated, std::optional<double> isolated_mhz,
    report::CaseResult& result);

// trust.pass_sum_over_*, and a warning if the passes do not cover the whole frame. On a processor
// they are compared with the wall clock.
void addPassSum(
    std::span<const engine::FrameRecord> isolated, const EmptySubmission& empty, bool processor,
    report::CaseResult& result);

// frame.overlap: the time that a frame saves by overlap, for each isolated frame and the overlapped
// frame of the same position. Each isolated pass contains `empty_pass` ms of barriers and
// timestamps, which are not the frame's. Adds nothing without passes or without that time.
void addOverlap(
    std::span<const engine::FrameRecord> isolated, std::span<const engine::FrameRecord> overlapped,
    std::optional<double> empty_pass, report::CaseResult& result);

// CPU use of whole isolated frames: frame.cpu.time and, if instructions are counted,
// frame.instructions.
void addFrameUse(std::span<const engine::FrameRecord> isolated, report::CaseResult& result);

// CPU use of passes in wall-clock frames: pass.*.cpu.time, pass.*.instructions.
void addPassUse(std::span<const engine::FrameRecord> wall_clock, report::CaseResult& result);

// Device memory, B, each with one sample: "memory.heap.<index>" for each heap in use and
// "memory.purpose.<purpose>" for each purpose in use. Both sum to all allocated memory.
std::vector<report::Metric> memoryMetrics(const engine::MemoryLedger& ledger);

// ---- Shaders ------------------------------------------------------------------------------------

// Costs of shaders as the driver's compiler tells them (VK_KHR_pipeline_executable_properties).
// They have no noise, and a driver tells them on a machine without its GPU, too.

// Adds what a driver tells of a case's programs to the case's result: every figure under the
// driver's name, and as metrics shader.STAGES.* those that drivers share. STAGES are the paths of
// the program's shaders, with ':' for '.' and joined by '&'. If several programs have the same
// stages, as for other constants or widths, the metric is the worst of them.
void addShaderCosts(std::span<const engine::ShaderProgram> programs, report::CaseResult& result);

// Returns a table of the metrics shader.*, with one row per program. Each figure is the worst of
// all cases.
std::string shaderTable(std::span<const report::CaseResult> cases);

}  // namespace benchmarks::measure
