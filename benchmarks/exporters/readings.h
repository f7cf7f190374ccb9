#pragma once

#include <string>
#include <vector>

#include "benchmarks/json_fwd.h"

// What exporters take from a written report. A member that a report must have and has not is
// thrown by nlohmann: exportReport() makes it an engine::Error.
namespace benchmarks {

// A metric of a case. Statistics are in the unit; what an older report does not say is absent from
// `metric` too.
struct Reading {
    std::string case_name;
    std::string name;  // "pass.strands.time"
    std::string unit;
    double median;
    const Json* metric;  // of the report, which has to outlive this
};

// Of all cases that ran, in the report's order.
std::vector<Reading> readings(const Json& report);

// A duration of a frame or pass of which less is better: in ms, and not a difference of two, which
// may be negative, nor a wait, which grows when others get faster.
bool isTime(const Reading& reading);

// The time of a pass itself: "pass.strands.time", and not "pass.strands.cpu.time".
bool isPassTime(const std::string& metric);

// "<case>/<metric>", which no two readings share.
std::string benchmarkName(const Reading& reading);

// The pointers of all cases' axes, each once.
std::vector<std::string> axisPointers(const Json& report);

// The member's text without quotes, as a table shows it: "" where it is absent.
std::string cellText(const Json& object, const std::string& member);

// JSON with LF at its end. What drivers say need not be UTF-8.
std::string documentText(const Json& document);

}  // namespace benchmarks
