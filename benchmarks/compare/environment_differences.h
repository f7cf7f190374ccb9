#pragma once

#include <string>
#include <vector>

#include "benchmarks/json_fwd.h"

namespace benchmarks {

// Whether both reports name the same device and kind of device; its driver may have changed.
bool isSameDevice(const Json& a, const Json& b);

// Why times of two reports may differ though the code does not: "device: X and Y", one line for
// each of device, driver, processor, the build's type, the scene, validation, and a report that was
// interrupted. A member that either report lacks is not known to differ.
std::vector<std::string> environmentDifferences(const Json& a, const Json& b);

}  // namespace benchmarks
