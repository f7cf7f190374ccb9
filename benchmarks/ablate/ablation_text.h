#pragma once

#include <string>

#include "benchmarks/ablate/ablation.h"

namespace benchmarks {

inline constexpr const char* kAblationSchema = "hairbench-ablation/1.0.0";

// Indented JSON: results/ablation.schema.json describes it. What is not known is absent.
std::string ablationText(const AblationReport& report);

// For a terminal: the rungs with their costs, what they leave open, and the warnings.
std::string ablationTable(const CaseAblation& ablation);

}  // namespace benchmarks
