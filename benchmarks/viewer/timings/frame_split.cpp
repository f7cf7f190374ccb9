#include "benchmarks/viewer/timings/frame_split.h"

#include <vector>

#include "benchmarks/measure/metrics.h"
#include "benchmarks/trust.h"
#include "benchmarks/viewer/timings/frame_metrics.h"

namespace benchmarks {

namespace {

constexpr double kLow = 0.01;

template <class Get>
double medianOf(const TimedFrames& frames, Get get) {
    std::vector<double> values;
    for (const engine::FrameRecord& frame : frames.records) values.push_back(get(frame));
    return summarize(values).median;
}

std::optional<double> medianOf(const CaseResult& metrics, const MetricId& id) {
    const Metric* const metric = metricOf(metrics, id);
    if (!metric) return std::nullopt;
    return summarize(metric->samples).median;
}

}  // namespace

std::optional<FrameRate> frameRate(const CaseResult& metrics) {
    const Metric* const walls = metricOf(metrics, ofFrame(Measured::isolated_time));
    if (!walls) return std::nullopt;
    FrameRate rate{
        .fps = framesPerSecond(walls->samples),
        .median = summarize(walls->samples).median,
        .low = std::nullopt};
    if (walls->samples.size() >= fewestForLow(kLow)) rate.low = lowRates(walls->samples, kLow);
    return rate;
}

std::optional<double> FrameSplit::saved() const {
    if (!device_overlapped) return std::nullopt;
    return pass_sum - *device_overlapped;
}

std::optional<FrameSplit> frameSplit(const TimingHistory& history, const CaseResult& metrics) {
    const TimedFrames& frames = history.isolated();
    if (frames.size() == 0) return std::nullopt;
    return FrameSplit{
        .record = medianOf(frames, [](auto& frame) { return frame.record; }),
        .submit = medianOf(frames, [](auto& frame) { return frame.submit; }),
        .wait = medianOf(frames, [](auto& frame) { return frame.wait; }),
        .cpu = medianOf(metrics, ofFrame(Measured::cpu_time)),
        .device = medianOf(frames, [](auto& frame) { return frame.device; }),
        .pass_sum = medianOf(frames, passSum),
        .device_overlapped = medianOf(metrics, ofFrame(Measured::device_time))};
}

}  // namespace benchmarks
