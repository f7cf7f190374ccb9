#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/scene/json.h"

// The same scene in several reports, of other devices, drivers or builds.
namespace benchmarks::report {

// Times of frames over those of the same cases in the scene's first report.
struct TimeRatio {
    std::size_t cases = 0;  // that both measured
    double mean = 0.0;  // geometric, of the medians' ratios
    double least = 0.0;
    double greatest = 0.0;
};

struct OnDevice {
    std::size_t report = 0;  // its place in the list
    std::size_t first = 0;  // the first report of the same scene; itself, where it is that
    std::optional<TimeRatio> ratio;  // absent from the first, and where there is no such case
    std::vector<std::string> differences;  // from the first: "device: X and Y"
};

// One for each report, in their order. Reports are of one scene where it has one name. Cases are
// the same where they have one value on each axis of either sweep; where a sweep has no such axis,
// its scene's. Throws engine::Error for a report that names no scene or is damaged.
std::vector<OnDevice> compareDevices(std::span<const scene::Json> reports);

// [{"report", "first", "ratio": {"cases", "mean", "least", "greatest"}, "differences"}]
scene::Json devicesJson(const std::vector<OnDevice>& devices);

}  // namespace benchmarks::report
