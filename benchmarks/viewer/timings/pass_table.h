#pragma once

#include "benchmarks/viewer/timings/pass_rows.h"

namespace benchmarks {

// A bar of all passes, and of each: median, share, history and, where it is compared, the other
// side's median and the ratio. Below them and in no sum `ui`, the window itself; null: not known
// yet. What has no room is left out, the share first; the tooltip of the name has it all.
void passTable(const PassRows& rows, const PassRows* compared, const TimeSeries* ui);

}  // namespace benchmarks
