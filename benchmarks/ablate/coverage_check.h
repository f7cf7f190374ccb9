#pragma once

#include <span>
#include <string>
#include <vector>

#include "benchmarks/ablate/ablation.h"

namespace benchmarks {

// Where a stop without a fragment shader does not cover what the same one with it does. Not for
// shaders that discard fragments.
std::vector<std::string> coverageWarnings(std::span<const StopRecord> stops);

}  // namespace benchmarks
