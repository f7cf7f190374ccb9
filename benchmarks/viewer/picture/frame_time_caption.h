#pragma once

#include <string>

#include "benchmarks/viewer/timings/timing_history.h"

namespace benchmarks {

// "12.3 ms": the median over the isolated frames that are known, from submission to completion;
// empty while there are none.
std::string frameTimeCaption(const TimingHistory& history);

}  // namespace benchmarks
