#include "benchmarks/viewer/timings/frame_metrics.h"

#include <algorithm>
#include <iterator>

#include "benchmarks/measure/metrics.h"

namespace benchmarks {

namespace {

// Of an overlapped frame that has the device to itself.
bool holdsForOneFrame(std::string_view name) {
    return name == "frame.device.time" || name == "cpu.record.time" || name == "cpu.submit.time";
}

void addOverlapped(const TimedFrames& frames, CaseResult& result) {
    if (frames.size() == 0) return;
    CaseResult all;
    addOverlappedMetrics(frames.records, all);
    std::ranges::copy_if(all.metrics, std::back_inserter(result.metrics), [](const Metric& metric) {
        return holdsForOneFrame(metric.name);
    });
}

void addIsolated(const TimedFrames& frames, std::string_view device_type, CaseResult& result) {
    if (frames.size() == 0) return;
    addIsolatedMetrics(frames.records, result);
    addPassTimes(frames.records, "isolated", result);
    // What a software device costs is CPU time; of others it says little.
    if (device_type == "cpu") addFrameUse(frames.records, result);
    addPassSum(frames.records, result);
}

}  // namespace

CaseResult frameMetrics(const TimingHistory& history, std::string_view device_type) {
    CaseResult result;
    addOverlapped(history.overlapped(), result);
    addIsolated(history.isolated(), device_type, result);
    return result;
}

const Metric* metricOf(const CaseResult& result, std::string_view name) {
    const auto found = std::ranges::find(result.metrics, name, &Metric::name);
    return found == result.metrics.end() || found->samples.empty() ? nullptr : &*found;
}

}  // namespace benchmarks
