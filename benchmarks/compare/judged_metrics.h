#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>

#include "benchmarks/json_fwd.h"

// Which metrics of a report a comparison passes a verdict on.
namespace benchmarks {

// A metric of a case in one report.
struct MetricReading {
    std::string name;  // "pass.strands.time"
    std::string unit;
    std::string mode;  // how it was timed; may be empty
    std::string hint;  // "lower" or "higher" is better; empty: neither
    double median = 0.0;
    std::optional<double> lower{};  // the median's 95 % interval; absent: too few samples
    std::optional<double> upper{};
};

// Of a metric's object in a report. Reports of 1.0 say no hint: it then follows from the unit.
MetricReading readMetric(const std::string& name, const Json& metric);

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

// Whether a frame's or pass's metric is of Clock::processor: its CPU time or instructions.
bool isOfProcessor(const std::string& metric);

// What is judged unless --metrics says otherwise: the processor's time on a software device whose
// reports have it. Names are those of metrics that both reports have.
Clock judgedClock(bool software_device, std::span<const std::string> names);

// A regex of names chooses metrics, of those of which less or more is better. An empty one stands
// for the times of frames and passes by the wall clock, or for their CPU time and their
// instructions. Throws engine::Error "--metrics: ..." for a malformed one.
class JudgedMetrics {
public:
    JudgedMetrics(const std::string& regex, Clock clock);

    // `a` and `b` are the same metric in two reports.
    Judgement judge(const MetricReading& a, const MetricReading& b) const;

private:
    bool wants(const std::string& name) const;

    bool chosen_;
    Clock clock_;
    std::function<bool(const std::string&)> matches_;
};

// Larger is worse: the median, or 1 / median where higher is better.
double costOf(const MetricReading& metric);

}  // namespace benchmarks
