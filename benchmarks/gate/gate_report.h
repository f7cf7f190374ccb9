#pragma once

#include <string>
#include <vector>

#include "benchmarks/gate/gate_run.h"
#include "benchmarks/json_fwd.h"

namespace benchmarks {

inline constexpr const char* kGateSchema = "hairbench-gate/1.0.0";

// All of a gate, as results/gate.schema.json describes it: verdicts can be worked out again from
// it. What is not known is absent.
Json gateReport(
    const GateRun& run, const VerdictOptions& options, const std::vector<std::string>& command);

// The gate for a terminal: what was compared, what differs, a row for each metric, the verdicts'
// counts.
std::string gateText(const GateRun& run);

}  // namespace benchmarks
