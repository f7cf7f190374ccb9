#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "benchmarks/measure/measure.h"
#include "benchmarks/report/report.h"
#include "benchmarks/report/statistics.h"
#include "benchmarks/viewer/player.h"
#include "engine/device.h"
#include "engine/frame_loop.h"
#include "hair/settings.h"

// Figures of the frames that a side drew, for the panel, and reports of these figures or of a
// measurement like the runner's.
namespace benchmarks::viewer {

// Records of frames in one timing mode, oldest first.
struct TimedFrames {
    std::vector<engine::FrameRecord> records;
    std::vector<std::uint32_t> numbers;  // each frame's number in the simulation, from 0

    std::size_t size() const { return records.size(); }
};

// Records of the last drawn frames, by timing mode. The history must be cleared when settings
// change, so that frames of different settings do not mix.
class TimingHistory {
public:
    static constexpr std::size_t kFrames = 300;  // limit per mode

    // `timing` is isolated or overlapped.
    void add(const engine::FrameRecord& frame, engine::Timing timing, std::uint32_t number);
    void clear();

    const TimedFrames& isolated() const { return isolated_; }
    const TimedFrames& overlapped() const { return overlapped_; }

    // Changes with each clear(); earlier results then belong to other settings.
    std::uint64_t revision() const { return revision_; }

private:
    TimedFrames isolated_;
    TimedFrames overlapped_;
    std::uint64_t revision_ = 0;
};

// Returns a report's metrics of frames that the viewer drew: the runner's metrics by its own
// functions, and the sum of the passes over the frame. The viewer draws one frame at a time, so
// metrics that need two frames in flight are absent: fps, fps.low_*, frame.time, cpu.wait.time,
// gpu.wait.time.
report::CaseResult frameMetrics(const TimingHistory& history, engine::DeviceType device_type);

// Returns a metric with samples, or null.
const report::Metric* metricOf(const report::CaseResult& result, const report::MetricId& id);

// Frames per second of isolated frames, by the CPU's clock from submission to completion.
struct FrameRate {
    double fps = 0.0;
    double median = 0.0;  // ms
    std::optional<report::LowRates> low;  // "1 % low"; absent below fewestForLow(0.01) frames
};

// Returns the rate from frameMetrics(); nothing without isolated frames.
std::optional<FrameRate> frameRate(const report::CaseResult& metrics);

// Parts of a frame's time, medians in ms. Unknown values are absent.
struct FrameSplit {
    // CPU-side times of isolated frames: these three add up to the frame.
    double record = 0.0;
    double submit = 0.0;
    double wait = 0.0;  // until the device has finished
    std::optional<double> cpu;  // CPU time of all threads of the process
    std::optional<double> device;  // isolated frames, from first to last timestamp
    double pass_sum = 0.0;  // isolated frames, the passes alone
    std::optional<double> device_overlapped;  // overlapped frames, from first to last timestamp

    // Returns the device time saved by overlapping passes.
    std::optional<double> saved() const;
};

// Times of a pass or another part, frame by frame.
struct TimeSeries {
    std::string name;
    std::vector<double> times;  // ms, oldest first
    std::vector<std::uint32_t> numbers;  // frame numbers; empty: without numbers
    report::Summary summary{};  // of the times; there is at least one
    // Quantile 0.99 of the times; absent with so few times that it equals the longest.
    std::optional<double> high;
};

TimeSeries
timeSeries(std::string name, std::vector<double> times, std::vector<std::uint32_t> numbers);

struct PassRows {
    TimeSeries sum;  // sum of all passes of a frame
    std::vector<TimeSeries> passes;

    // Returns a pass's share of the passes' sum, by medians.
    double share(const TimeSeries& pass) const;
    // Returns null if there is no pass of that name.
    const TimeSeries* find(const std::string& name) const;
};

// Returns the passes of isolated frames; nothing without frames.
std::optional<PassRows> passRows(const TimedFrames& isolated);

// The panel's values for a side, copied so that they can be frozen.
struct ShownSide {
    report::CaseResult metrics;  // frameMetrics(), and the case's counts if known
    std::optional<FrameRate> rate;
    std::optional<PassRows> passes;
    std::optional<FrameSplit> split;
    std::size_t isolated = 0;  // frames
    std::size_t overlapped = 0;
    // Numbers of the first and last frame; absent without frames.
    std::optional<std::pair<std::uint32_t, std::uint32_t>> range;
};

ShownSide shownTimings(const TimingHistory& history, engine::DeviceType device_type);

// "12.3 ms": the median time of the isolated frames, from submission to completion; empty without
// frames.
std::string frameTimeCaption(const TimingHistory& history);

// ---- Reports ------------------------------------------------------------------------------------

// Adds a warning if shaders, given by their paths, differ from the build's: the report then does
// not describe the build that it names.
void warnOfChangedShaders(std::span<const std::string> replaced, report::Trust& trust);

// Draws the frame that a case shows again, untimed, and counts with pipeline statistics like the
// runner: result.statistics, and a warning for each unexpected count. Leaves the frame and its
// picture unchanged. Empty if the device has no pipeline statistics.
report::CaseResult countStatistics(const engine::Device& device, measure::Case& shown);

// The shown values of a side at the time when the user froze it.
struct FrozenSide {
    ShownSide shown;
    hair::Settings settings;
    std::uint32_t frame = 0;  // frame of the hashes
};

// Returns a frozen side, with the costs of blended fragments and, unless it shows a preview, the
// hashes of the picture and the guides.
FrozenSide frozenSide(const Shown& seen, ShownSide shown);

// Returns a report's result for a frozen side: the metrics in their modes, `statistics` (from
// countStatistics(), or empty), and warnings that describe how all was measured.
report::CaseResult frozenResult(const FrozenSide& frozen, const report::CaseResult& statistics);

// Result of the runner's measurement of settings.
struct SideMeasurement {
    hair::Settings settings;
    report::CaseResult result;
    // [row][column] RGBA, top row first: the hashed picture.
    std::vector<std::uint8_t> picture;
};

// Measures settings like `hairbench run`, with a separate case, so that the shown side is
// unchanged. The memory in the result is that case's. Device work of `hooks.progress`, such as a
// picture of the window, finishes before the next round begins. Throws like Case and measure().
SideMeasurement measureSide(
    const engine::Device& device, const hair::Settings& settings,
    const std::filesystem::path& directory, const std::string& name,
    const measure::MeasureHooks& hooks);

// Origin of the viewer's values, for reports.
struct ReportOrigin {
    std::filesystem::path scene;
    std::string name;  // the scene's name
    std::vector<std::string> command;  // the command line that started the viewer
    engine::Validation validation = engine::Validation::off;
};

// Returns a report of one case, like the runner's for a scene with these settings and no sweep.
report::Report viewerReport(
    const engine::Device& device, const ReportOrigin& origin, const hair::Settings& settings,
    report::CaseResult result);

// results/local/<scene>-<kind>.json
std::filesystem::path reportPath(const ReportOrigin& origin, const std::string& kind);

// Writes a report, and beside it the case's picture, if any: [row][column] RGBA, top row first.
// Throws engine::Error "<path>: <reason>".
void saveReport(
    report::Report report, const hair::RenderSettings& render,
    std::span<const std::uint8_t> picture, const std::filesystem::path& file);

}  // namespace benchmarks::viewer
