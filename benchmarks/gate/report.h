#pragma once

#include <string>
#include <vector>

#include "benchmarks/gate/session.h"
#include "benchmarks/scene/json.h"

// Report of a gate, as JSON and for a terminal.
namespace benchmarks::gate {

inline constexpr const char* kGateSchema = "hairbench-gate/1.2.0";

// The complete gate, as described by results/gate.schema.json; verdicts can be recomputed from it.
// Unknown values are absent.
scene::Json gateReport(
    const GateRun& run, const report::VerdictOptions& options,
    const std::vector<std::string>& command);

// Text for a terminal: the sides, the differences, a row per metric, and the counts of verdicts.
std::string gateText(const GateRun& run);

}  // namespace benchmarks::gate
