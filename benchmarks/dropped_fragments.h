#pragma once

#include <string>

#include "benchmarks/case.h"

namespace benchmarks {

// What the last picture lacks for want of room in its lists of fragments; empty: nothing. Waits for
// the device.
std::string droppedFragments(const Case& test_case);

}  // namespace benchmarks
