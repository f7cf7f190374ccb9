#pragma once

#include <string>

namespace benchmarks {

// What is better of a metric: "lower" or "higher"; empty where neither is.
std::string hintOf(const std::string& name, const std::string& unit);

}  // namespace benchmarks
