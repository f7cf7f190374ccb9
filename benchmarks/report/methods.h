#pragma once

#include <string>

#include "benchmarks/scene/json.h"

// What a report's numbers are, in words.
namespace benchmarks::report {

// A paragraph for a paper's section on methods, in English: device, driver, clocks, warm-up,
// samples, statistic and interval, and what was left out. Hoefler and Belli, Scientific
// Benchmarking of Parallel Computing Systems (SC 2015, doi 10.1145/2807591.2807644), ask for these
// in their rules 2 (what was measured and what not), 5 and 6 (nondeterminism, distributions,
// intervals), 9 (the whole setting) and 10 (how time was taken). Says nothing of what the report
// does not know. `report` is a whole one, without its samples' sidecar if need be.
std::string methodsText(const scene::Json& report);

}  // namespace benchmarks::report
