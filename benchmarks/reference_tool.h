#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace benchmarks {

// Runs a tool of benchmarks/reference/ in the environment of scripts/setup --reference and hands
// over each line that it writes to stdout. Throws engine::Error of one line, or Interrupted.
// $HAIRBENCH_REFERENCE_PYTHON is an interpreter to use instead.
void runReferenceTool(
    const std::string& script, const std::vector<std::string>& arguments,
    const std::function<void(std::string_view line)>& each_line);

// Throws the error of a missing environment before the work that would need it.
void checkReferenceTool();

}  // namespace benchmarks
