#pragma once

#include <vector>

#include "benchmarks/report.h"

namespace benchmarks {

// Pipeline statistics: each count, whether it is the expected one where there is one, and notes.
void statisticsTable(const std::vector<Statistic>& statistics);

}  // namespace benchmarks
