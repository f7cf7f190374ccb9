#pragma once

#include <string>

#include "benchmarks/report.h"

namespace benchmarks {

// Medians of a measured case's times and rates with the intervals that its report has, how many
// rounds it took, and its warnings.
void measuredTable(const CaseResult& result);

// "12.3 (12.1 to 12.6)": the median, and where it lies with 95 % confidence; without an interval
// where there are too few samples for one.
std::string medianText(const Metric& metric);

}  // namespace benchmarks
