#include "benchmarks/viewer/timings/frame_metrics.h"

#include <algorithm>
#include <iterator>

#include "benchmarks/measure/metrics.h"

namespace benchmarks {

namespace {

// Of an overlapped frame that has the device to itself.
bool holdsForOneFrame(const MetricId& id) {
    return id == ofFrame(Measured::device_time) || id == ofCpu(Measured::record_time) ||
           id == ofCpu(Measured::submit_time);
}

void addOverlapped(const TimedFrames& frames, CaseResult& result) {
    if (frames.size() == 0) return;
    CaseResult all;
    addOverlappedMetrics(frames.records, all);
    std::ranges::copy_if(all.metrics, std::back_inserter(result.metrics), [](const Metric& metric) {
        return holdsForOneFrame(metric.id);
    });
}

void addIsolated(const TimedFrames& frames, std::string_view device_type, CaseResult& result) {
    if (frames.size() == 0) return;
    addIsolatedMetrics(frames.records, result);
    addPassTimes(frames.records, Mode::isolated, result);
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

const Metric* metricOf(const CaseResult& result, const MetricId& id) {
    const Metric* const found = findMetric(result.metrics, id);
    return found && !found->samples.empty() ? found : nullptr;
}

}  // namespace benchmarks
