#pragma once

#include "benchmarks/run/run_plan.h"

namespace benchmarks {

// Prints the names of the cases and how many there are. Returns the exit status.
int printNames(const RunPlan& plan);

// Seconds that measuring a case takes if its median is not known well enough before /run/max_time,
// its timestamps are tested as long as they ever are and are not trusted in the end. Making the
// case is not in it. `frame_ms`: of one frame.
double mostSeconds(const hair::RunSettings& run, double frame_ms);

// Prints each case with the device memory that it takes and how long measuring it takes at most,
// and their sum: cases are made and play a few frames. Where there is no device, names alone and
// why. Returns the exit status.
int estimateRun(const RunPlan& plan, const engine::DeviceOptions& device);

}  // namespace benchmarks
