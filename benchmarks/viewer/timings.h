#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "benchmarks/report/report.h"
#include "benchmarks/report/statistics.h"
#include "benchmarks/viewer/player.h"

namespace benchmarks::viewer {

// What a report has of frames that the viewer drew: the runner's metrics, by its own functions, and
// how far the passes add up to the frame. The viewer draws one frame at a time, so those that take
// two in flight are not there: fps, fps.low_*, frame.time, cpu.wait.time, gpu.wait.time.
// `device_type` as in DeviceRecord.
report::CaseResult frameMetrics(const TimingHistory& history, std::string_view device_type);

// Null where there is no such metric or it has no sample.
const report::Metric* metricOf(const report::CaseResult& result, const report::MetricId& id);

// Frames per second of isolated frames, by the CPU's clock from submission to completion.
struct FrameRate {
    double fps = 0.0;
    double median = 0.0;  // ms
    std::optional<report::LowRates> low;  // "1 % low"; absent below fewestForLow(0.01) frames
};

// `metrics` are frameMetrics(); none where they have no isolated frame.
std::optional<FrameRate> frameRate(const report::CaseResult& metrics);

// Where a frame's time goes, medians in ms. What is not known is absent.
struct FrameSplit {
    // On the CPU, of isolated frames: they add up to the frame.
    double record = 0.0;
    double submit = 0.0;
    double wait = 0.0;  // until the device is done
    std::optional<double> cpu;  // time of all threads of the process
    // On the device: from first to last timestamp.
    double device = 0.0;  // of isolated frames
    double pass_sum = 0.0;  // the passes alone, of isolated frames
    std::optional<double> device_overlapped;  // of overlapped frames

    // What passing side by side saves the device.
    std::optional<double> saved() const;
};

// None where there is no isolated frame.
std::optional<FrameSplit>
frameSplit(const TimingHistory& history, const report::CaseResult& metrics);

// Times of one thing, frame by frame.
struct TimeSeries {
    std::string name;
    std::vector<double> times;  // ms, oldest first
    std::vector<std::uint32_t> numbers;  // of the frames; empty: they have none
    report::Summary summary{};  // of the times, which are at least one
    // Their quantile 0.99; absent where there are so few that it is the longest of them.
    std::optional<double> high;
};

TimeSeries
timeSeries(std::string name, std::vector<double> times, std::vector<std::uint32_t> numbers);

struct PassRows {
    TimeSeries sum;  // of all passes of a frame
    std::vector<TimeSeries> passes;

    // Of the passes' sum, by medians.
    double share(const TimeSeries& pass) const;
    // Null where there is no pass of that name.
    const TimeSeries* find(const std::string& name) const;
};

// By isolated frames; none where there are none.
std::optional<PassRows> passRows(const TimedFrames& isolated);

// What the panel shows of a side: a value, so that it can be frozen.
struct ShownSide {
    report::CaseResult metrics;  // frameMetrics(), and the case's counts where they are known
    std::optional<FrameRate> rate;
    std::optional<PassRows> passes;
    std::optional<FrameSplit> split;
    std::size_t isolated = 0;  // frames
    std::size_t overlapped = 0;
    // Numbers of the first and last of them all; absent where there are none.
    std::optional<std::pair<std::uint32_t, std::uint32_t>> range;
};

ShownSide shownTimings(const TimingHistory& history, std::string_view device_type);
// With the counts of what the side plays.
ShownSide shownSide(const Side& side, std::string_view device_type);

}  // namespace benchmarks::viewer
