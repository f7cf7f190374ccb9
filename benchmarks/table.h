#pragma once

#include <string>

#include "benchmarks/json_fwd.h"

namespace benchmarks {

// A report (reportJson) for a terminal: a line on the device and the scene, then a row per case:
// the axes that vary, FPS, the median of the frame and of every pass, strands, and how it went.
// What is not known is "-".
std::string table(const Json& report);

// About three significant digits without an exponent: "1234", "123", "12.3", "1.23", "0.0123".
std::string shortNumber(double number);

}  // namespace benchmarks
