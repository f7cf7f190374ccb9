#pragma once

#include <string>
#include <vector>

#include "benchmarks/gate/session.h"
#include "benchmarks/scene/json.h"

// Report of a gate, as JSON and for a terminal.
namespace benchmarks::gate {

inline constexpr const char* kGateSchema = "hairbench-gate/1.1.0";

// All of a gate, as results/gate.schema.json describes it: verdicts can be worked out again from
// it. What is not known is absent.
scene::Json gateReport(
    const GateRun& run, const report::VerdictOptions& options,
    const std::vector<std::string>& command);

// The gate for a terminal: what was compared, what differs, a row for each metric, the verdicts'
// counts.
std::string gateText(const GateRun& run);

}  // namespace benchmarks::gate
