#pragma once

#include <string>
#include <vector>

#include "benchmarks/measure/case.h"
#include "benchmarks/report/report.h"
#include "hair/settings.h"

// What the hair is like before the first frame, and what is wrong with it.
namespace benchmarks::measure {

struct StartInspection {
    report::StartRecord record;
    std::vector<std::string> warnings;
};

// Of a case that has played no frame. Waits for the device.
StartInspection inspectStart(const Case& test_case);

// The same of what was found.
StartInspection judgeStart(
    const hair::simulation::GuideCondition& condition, const hair::simulation::RestBalance* balance,
    const hair::Settings& settings);

}  // namespace benchmarks::measure
