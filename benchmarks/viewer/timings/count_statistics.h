#pragma once

#include "benchmarks/case.h"
#include "benchmarks/report.h"
#include "engine/device.h"

namespace benchmarks {

// Draws the frame that a case shows once more, untimed, and counts with pipeline statistics as the
// runner does: result.statistics, and a warning for each count that is not as expected. The frame
// and its picture stay what they were. Nothing where the device counts none.
CaseResult countStatistics(const engine::Device& device, Case& shown);

}  // namespace benchmarks
