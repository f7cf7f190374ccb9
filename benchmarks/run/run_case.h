#pragma once

#include <filesystem>

#include "benchmarks/measure.h"
#include "benchmarks/picture_errors.h"
#include "benchmarks/report.h"
#include "benchmarks/run/run_plan.h"
#include "engine/device.h"

namespace benchmarks {

// Measures a case. One that can't run here, or that fails, is part of the result with its reason.
// `report` is the file beside which its picture goes; empty: none is written. Throws Interrupted.
CaseResult runCase(
    const engine::Device& device, const PlannedCase& planned, const MeasureHooks& hooks,
    const std::filesystem::path& report, ReferenceComparison& references);

}  // namespace benchmarks
