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
#include "engine/device.h"
#include "engine/frame_loop.h"
#include "hair/settings.h"

// What is known of how long frames take: the history of the frames that a side drew, the figures
// that the panel shows of it, and reports of these figures or of a measurement like the runner's.
namespace benchmarks::viewer {

class Side;  // player.h

// Records of frames that were timed in one way, oldest first.
struct TimedFrames {
    std::vector<engine::FrameRecord> records;
    std::vector<std::uint32_t> numbers;  // each frame's number in the simulation, from 0

    std::size_t size() const { return records.size(); }
};

// Records of the last frames that were drawn, by the way they were timed. Frames of different
// settings don't mix: whoever changes the settings clears the history.
class TimingHistory {
public:
    static constexpr std::size_t kFrames = 300;  // kept of each way

    // `timing` is isolated or overlapped.
    void add(const engine::FrameRecord& frame, engine::Timing timing, std::uint32_t number);
    void clear();

    const TimedFrames& isolated() const { return isolated_; }
    const TimedFrames& overlapped() const { return overlapped_; }

    // Changes with each clear(): what was found out before is of other settings.
    std::uint64_t revision() const { return revision_; }

private:
    TimedFrames isolated_;
    TimedFrames overlapped_;
    std::uint64_t revision_ = 0;
};

// What a report has of frames that the viewer drew: the runner's metrics, by its own functions, and
// how far the passes add up to the frame. The viewer draws one frame at a time, so metrics that
// take two frames in flight are absent: fps, fps.low_*, frame.time, cpu.wait.time, gpu.wait.time.
// `device_type` as in DeviceRecord.
report::CaseResult frameMetrics(const TimingHistory& history, std::string_view device_type);

// A metric with samples; null where there is none.
const report::Metric* metricOf(const report::CaseResult& result, const report::MetricId& id);

// Frames per second of isolated frames, by the CPU's clock from submission to completion.
struct FrameRate {
    double fps = 0.0;
    double median = 0.0;  // ms
    std::optional<report::LowRates> low;  // "1 % low"; absent below fewestForLow(0.01) frames
};

// The rate by frameMetrics(); none where they have no isolated frame.
std::optional<FrameRate> frameRate(const report::CaseResult& metrics);

// Where a frame's time goes, medians in ms. What is not known is absent.
struct FrameSplit {
    // Time on the CPU of isolated frames: these three add up to the frame.
    double record = 0.0;
    double submit = 0.0;
    double wait = 0.0;  // until the device is done
    std::optional<double> cpu;  // CPU time of all threads of the process
    std::optional<double> device;  // isolated frames, from first to last timestamp
    double pass_sum = 0.0;  // isolated frames, the passes alone
    std::optional<double> device_overlapped;  // overlapped frames, from first to last timestamp

    // What overlap of passes saves the device.
    std::optional<double> saved() const;
};

// Times of one thing, frame by frame.
struct TimeSeries {
    std::string name;
    std::vector<double> times;  // ms, oldest first
    std::vector<std::uint32_t> numbers;  // the frames' numbers; empty: they have none
    report::Summary summary{};  // of the times; there is at least one
    // The times' quantile 0.99; absent with so few times that it is the longest.
    std::optional<double> high;
};

TimeSeries
timeSeries(std::string name, std::vector<double> times, std::vector<std::uint32_t> numbers);

struct PassRows {
    TimeSeries sum;  // all passes of a frame added up
    std::vector<TimeSeries> passes;

    // A pass's share of the passes' sum, by medians.
    double share(const TimeSeries& pass) const;
    // Null where there is no pass of that name.
    const TimeSeries* find(const std::string& name) const;
};

// The passes of isolated frames; none where there are no frames.
std::optional<PassRows> passRows(const TimedFrames& isolated);

// What the panel shows of a side: a value, so that it can be frozen.
struct ShownSide {
    report::CaseResult metrics;  // frameMetrics(), and the case's counts where they are known
    std::optional<FrameRate> rate;
    std::optional<PassRows> passes;
    std::optional<FrameSplit> split;
    std::size_t isolated = 0;  // frames
    std::size_t overlapped = 0;
    // Numbers of the first and last frame; absent where there are none.
    std::optional<std::pair<std::uint32_t, std::uint32_t>> range;
};

ShownSide shownTimings(const TimingHistory& history, std::string_view device_type);
// shownTimings() with the counts of what the side plays, and what draws its strands.
ShownSide shownSide(const Side& side, std::string_view device_type);

// "12.3 ms": the median time of the isolated frames, from submission to completion; empty while
// there are none.
std::string frameTimeCaption(const TimingHistory& history);

// ---- Reports ------------------------------------------------------------------------------------

// Adds a warning where shaders, by their paths, are not those that the program was built with: the
// report does not describe the build that it names.
void warnOfChangedShaders(std::span<const std::string> replaced, report::Trust& trust);

// Draws the frame that a case shows once more, untimed, and counts with pipeline statistics as the
// runner does: result.statistics, and a warning for each count that is not as expected. The frame
// and its picture stay what they were. Empty where the device has no pipeline statistics.
report::CaseResult countStatistics(const engine::Device& device, measure::Case& shown);

// What was shown of a side when the user froze it.
struct FrozenSide {
    ShownSide shown;
    hair::Settings settings;
    std::uint32_t frame = 0;  // the frame that the hashes are of
};

// A frozen side, with what blended fragments took, and the hashes of the picture and the guides,
// unless the side shows a preview.
FrozenSide frozenSide(const Side& side, ShownSide shown);

// What a report has of a frozen side: the metrics in their modes, `statistics` (countStatistics(),
// or nothing), and warnings that say how it was all measured.
report::CaseResult frozenResult(const FrozenSide& frozen, const report::CaseResult& statistics);

// What the runner's measurement of settings gave.
struct SideMeasurement {
    hair::Settings settings;
    report::CaseResult result;
    // [row][column] RGBA, top row first: the picture that is hashed.
    std::vector<std::uint8_t> picture;
};

// Measures settings as `hairbench run` does, with a case of its own, so that what is shown stays as
// it is. The memory in the result is that case's. What `hooks.progress` does to the device, such as
// a picture of the window, is done before the next round begins. Throws as Case and measure().
SideMeasurement measureSide(
    const engine::Device& device, const hair::Settings& settings,
    const std::filesystem::path& directory, const std::string& name,
    const measure::MeasureHooks& hooks);

// Where what the viewer shows came from, for reports.
struct ReportOrigin {
    std::filesystem::path scene;
    std::string name;  // the scene's name
    std::vector<std::string> command;  // the command line that started the viewer
    engine::Validation validation = engine::Validation::off;
};

// The report of one case, as the runner's of a scene that has these settings and no sweep.
report::Report viewerReport(
    const engine::Device& device, const ReportOrigin& origin, const hair::Settings& settings,
    report::CaseResult result);

// results/local/<scene>-<kind>.json
std::filesystem::path reportPath(const ReportOrigin& origin, const std::string& kind);

// Writes a report, with the case's picture beside it where there is one: [row][column] RGBA, top
// row first. Throws engine::Error "<path>: <reason>".
void saveReport(
    report::Report report, const hair::RenderSettings& render,
    std::span<const std::uint8_t> picture, const std::filesystem::path& file);

}  // namespace benchmarks::viewer
