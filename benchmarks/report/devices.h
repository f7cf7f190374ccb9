#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/scene/json.h"

// Compares reports of the same scene on several devices, drivers or builds.
namespace benchmarks::report {

// Ratios of frame times to those of the same cases in the scene's first report.
struct TimeRatio {
    std::size_t cases = 0;  // cases that both reports measured
    double mean = 0.0;  // geometric mean of the ratios of medians
    double least = 0.0;
    double greatest = 0.0;
};

struct OnDevice {
    std::size_t report = 0;  // index in the list of reports
    std::size_t first = 0;  // index of the first report of the same scene, which may be this one
    std::optional<TimeRatio> ratio;  // absent for the first report, and without common cases
    std::vector<std::string> differences;  // from the first report: "device: X and Y"
};

// Returns one entry per report, in their order. Two reports belong to the same scene if its name is
// equal. Two cases are the same if their values are equal on every axis of either sweep; if a sweep
// lacks an axis, its scene's value counts. Throws engine::Error for a damaged report or one without
// a scene.
std::vector<OnDevice> compareDevices(std::span<const scene::Json> reports);

// [{"report", "first", "ratio": {"cases", "mean", "least", "greatest"}, "differences"}]
scene::Json devicesJson(const std::vector<OnDevice>& devices);

}  // namespace benchmarks::report
