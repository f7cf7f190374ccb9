#pragma once

#include <optional>

#include "benchmarks/report.h"
#include "benchmarks/statistics.h"
#include "benchmarks/viewer/timings/timing_history.h"

namespace benchmarks {

// Frames per second of isolated frames, by the CPU's clock from submission to completion.
struct FrameRate {
    double fps = 0.0;
    double median = 0.0;  // ms
    std::optional<LowRates> low;  // "1 % low"; absent below fewestForLow(0.01) frames
};

// `metrics` are frameMetrics(); none where they have no isolated frame.
std::optional<FrameRate> frameRate(const CaseResult& metrics);

// Where a frame's time goes, medians in ms. What is not known is absent.
struct FrameSplit {
    // On the CPU, of isolated frames: they add up to the frame.
    double record = 0.0;
    double submit = 0.0;
    double wait = 0.0;  // until the device is done
    std::optional<double> cpu;  // time of all threads of the process
    // On the device: from first to last timestamp.
    double device = 0.0;                      // of isolated frames
    double pass_sum = 0.0;                    // the passes alone, of isolated frames
    std::optional<double> device_overlapped;  // of overlapped frames

    // What passing side by side saves the device.
    std::optional<double> saved() const;
};

// None where there is no isolated frame.
std::optional<FrameSplit> frameSplit(const TimingHistory& history, const CaseResult& metrics);

}  // namespace benchmarks
