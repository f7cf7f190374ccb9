#pragma once

#include <functional>
#include <span>
#include <string>

#include "benchmarks/json_fwd.h"
#include "benchmarks/metric.h"

// Which metrics of a report a comparison passes a verdict on.
namespace benchmarks {

// Whether the report's device is the processor itself, where CPU time is what passes cost.
bool isSoftwareDevice(const Json& environment);

// Where a time is shorter in both builds it is not judged: 2 % of it are 1 us, which is the step of
// coarse timestamps and less than it takes to wake a thread.
inline constexpr double kShortestTime = 0.05;  // ms

enum class Judgement { judged, too_short, not_wanted };

// What times are of.
enum class Clock {
    wall,
    processor,  // what all threads used: on a software device what a pass costs, whoever else is at
                // work on the machine; it does not see that threads wait for each other
};

// What is judged unless --metrics says otherwise: the processor's time on a software device whose
// reports have it. `metrics` are those that both reports have.
Clock judgedClock(bool software_device, std::span<const MetricId> metrics);

// Which metrics count.
using MetricChoice = std::function<bool(const MetricId&)>;

// Those in whose name a regex is found; an empty function for an empty one. Throws engine::Error
// "--metrics: ..." for a malformed one.
MetricChoice metricsNamed(const std::string& regex);

// The times of frames and passes by the wall clock, or their CPU time and their instructions.
MetricChoice timesBy(Clock clock);

// Of the same metric in two reports. One of which neither less nor more is better is not judged.
Judgement judgementOf(const MetricChoice& chosen, const MetricReading& a, const MetricReading& b);

// Larger is worse: a value in the metric's unit, or 1 / value where higher is better.
double costOf(const Metric& metric, double value);

}  // namespace benchmarks
