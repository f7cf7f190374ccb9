#pragma once

#include <string_view>

#include "benchmarks/report.h"
#include "benchmarks/viewer/timings/timing_history.h"

namespace benchmarks {

// What a report has of frames that the viewer drew: the runner's metrics, by its own functions, and
// how far the passes add up to the frame. The viewer draws one frame at a time, so those that take
// two in flight are not there: fps, fps.low_*, frame.time, cpu.wait.time, gpu.wait.time.
// `device_type` as in DeviceRecord.
CaseResult frameMetrics(const TimingHistory& history, std::string_view device_type);

// Null where there is no such metric or it has no sample.
const Metric* metricOf(const CaseResult& result, const MetricId& id);

}  // namespace benchmarks
