#include <algorithm>
#include <cmath>
#include <string>
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

void addLows(
    const std::vector<double>& intervals, const std::string& name, double fraction,
    CaseResult& result) {
    if (intervals.size() < fewestForLow(fraction)) return;
    const LowRates low = lowRates(intervals, fraction);
    const auto add = [&](const char* definition, double rate) {
        result.metrics.push_back({name + definition, "1/s", {rate}, "overlapped"});
    };
    add(".percentile", low.percentile);
    add(".mean", low.mean);
    add(".integral", low.integral);
}

}  // namespace

std::size_t fewestForLow(double fraction) {
    return static_cast<std::size_t>(std::lround(1.0 / fraction));
}

void addOverlappedMetrics(std::span<const FrameRecord> frames, CaseResult& result) {
    const std::vector<double> intervals = collect(frames, [](auto& f) { return f.interval; });
    result.metrics.push_back({"fps", "1/s", {framesPerSecond(intervals)}, "overlapped"});
    addLows(intervals, "fps.low_1", 0.01, result);
    addLows(intervals, "fps.low_0_1", 0.001, result);
    const auto addTimes = [&](const char* name, auto get) {
        result.metrics.push_back({name, "ms", collect(frames, get), "overlapped"});
    };
    addTimes("frame.time", [](auto& f) { return f.interval; });
    addTimes("frame.device.time", [](auto& f) { return f.device; });
    addTimes("cpu.record.time", [](auto& f) { return f.record; });
    addTimes("cpu.submit.time", [](auto& f) { return f.submit; });
    addTimes("cpu.wait.time", [](auto& f) { return f.wait; });
    // A frame whose work began before the last one's was done takes the device longer than its
    // interval, and then the device waited for nobody.
    addTimes("gpu.wait.time", [](auto& f) { return std::max(f.interval - f.device, 0.0); });
}

}  // namespace benchmarks
