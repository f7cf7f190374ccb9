#pragma once

#include <string>

#include "benchmarks/json_fwd.h"

namespace benchmarks {

// JSON text as scenes/ has it, with a newline at the end: members of the document on lines of their
// own, indented by two spaces; whatever is inside them on one line where that has 100 columns at
// most.
std::string readableJson(const Json& document);

}  // namespace benchmarks
