#pragma once

#include <optional>
#include <string>

#include "benchmarks/json_fwd.h"

namespace benchmarks {

// In what two reports, or their headers (headerJson), differ that one sweep has in common: the
// scene, the number of its cases, the build, the device and its driver, on a software device the
// processor. "driver version: 1.2 is not 1.3", `a` first; nothing where they belong together.
std::optional<std::string> identityDifference(const Json& a, const Json& b);

}  // namespace benchmarks
