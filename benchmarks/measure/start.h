#pragma once

#include <string>
#include <vector>

#include "benchmarks/measure/case.h"
#include "benchmarks/report/report.h"
#include "hair/settings.h"

// The state of the hair before the first frame, and its faults.
namespace benchmarks::measure {

struct StartInspection {
    report::StartRecord record;
    std::vector<std::string> warnings;
};

// For a case that has played no frame. Waits for the device.
StartInspection inspectStart(const Case& test_case);

// Judges this state as inspectStart() does.
StartInspection judgeStart(
    const hair::simulation::GuideCondition& condition, const hair::simulation::RestBalance* balance,
    const hair::Settings& settings);

}  // namespace benchmarks::measure
