#pragma once

#include <string>
#include <vector>

#include "benchmarks/json_fwd.h"
#include "benchmarks/metric.h"

// What exporters take from a written report. A member that a report must have and has not is
// thrown by nlohmann: exportReport() makes it an engine::Error.
namespace benchmarks {

struct Reading {
    std::string case_name;
    MetricReading metric;
    // The metric in the report, which has to outlive this: statistics of the samples, in the unit.
    // What an older report does not say is absent.
    const Json* statistics;
};

// Of all cases that ran, in the report's order.
std::vector<Reading> readings(const Json& report);

// "<case>/<metric>", which no two readings share.
std::string benchmarkName(const Reading& reading);

// The pointers of all cases' axes, each once.
std::vector<std::string> axisPointers(const Json& report);

// The member's text without quotes, as a table shows it: "" where it is absent.
std::string cellText(const Json& object, const std::string& member);

// JSON with LF at its end. What drivers say need not be UTF-8.
std::string documentText(const Json& document);

}  // namespace benchmarks
