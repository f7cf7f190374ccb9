#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "benchmarks/measure/metrics.h"
#include "benchmarks/statistics.h"

namespace benchmarks {

namespace {

using engine::FrameRecord;

template <class Get>
std::vector<double> collect(std::span<const FrameRecord> frames, Get get) {
    std::vector<double> values;
    for (const FrameRecord& frame : frames) values.push_back(get(frame));
    return values;
}

// By the three definitions.
struct LowMetrics {
    Measured percentile;
    Measured mean;
    Measured integral;
};
constexpr LowMetrics kLow1{
    Measured::low_1_percentile, Measured::low_1_mean, Measured::low_1_integral};
constexpr LowMetrics kLow01{
    Measured::low_0_1_percentile, Measured::low_0_1_mean, Measured::low_0_1_integral};

void addLows(
    const std::vector<double>& intervals, double fraction, const LowMetrics& lows,
    CaseResult& result) {
    if (intervals.size() < fewestForLow(fraction)) return;
    const LowRates low = lowRates(intervals, fraction);
    const auto add = [&](Measured what, double rate) {
        result.metrics.push_back({ofFrame(what), {rate}, Mode::overlapped});
    };
    add(lows.percentile, low.percentile);
    add(lows.mean, low.mean);
    add(lows.integral, low.integral);
}

}  // namespace

std::size_t fewestForLow(double fraction) {
    return static_cast<std::size_t>(std::lround(1.0 / fraction));
}

void addOverlappedMetrics(std::span<const FrameRecord> frames, CaseResult& result) {
    const std::vector<double> intervals = collect(frames, [](auto& f) { return f.interval; });
    result.metrics.push_back(
        {ofFrame(Measured::rate), {framesPerSecond(intervals)}, Mode::overlapped});
    addLows(intervals, 0.01, kLow1, result);
    addLows(intervals, 0.001, kLow01, result);
    const auto addTimes = [&](MetricId id, auto get) {
        result.metrics.push_back({std::move(id), collect(frames, get), Mode::overlapped});
    };
    addTimes(ofFrame(Measured::time), [](auto& f) { return f.interval; });
    addTimes(ofFrame(Measured::device_time), [](auto& f) { return f.device; });
    addTimes(ofCpu(Measured::record_time), [](auto& f) { return f.record; });
    addTimes(ofCpu(Measured::submit_time), [](auto& f) { return f.submit; });
    addTimes(ofCpu(Measured::wait_time), [](auto& f) { return f.wait; });
    // A frame whose work began before the last one's was done takes the device longer than its
    // interval, and then the device waited for nobody.
    addTimes(
        ofGpu(Measured::wait_time), [](auto& f) { return std::max(f.interval - f.device, 0.0); });
}

}  // namespace benchmarks
