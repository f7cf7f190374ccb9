#pragma once

#include <string>

#include "benchmarks/report/report.h"
#include "benchmarks/scene/json.h"

// A report as a table for a terminal.
namespace benchmarks::report {

// Returns a table of a report (reportJson): a line on the device and the scene, one on what the
// columns are, then a row per case with the axes that vary, FPS, the median times of the frame, its
// interval, the median times of every pass, strands, verdict and status. Unknown values are "-".
std::string table(const scene::Json& report);

// Returns the same table from a report's header (headerJson) and cases that are visited one by one.
std::string table(const scene::Json& header, const EachCase& each_case);

}  // namespace benchmarks::report
