#pragma once

#include <string>

#include "benchmarks/viewer/picture/difference_pass.h"

namespace benchmarks {

// "at most 37 of 255, on average 0.42; 12.3 % of the pixels differ", or "identical".
std::string differenceText(const DifferenceFigures& figures);

}  // namespace benchmarks
