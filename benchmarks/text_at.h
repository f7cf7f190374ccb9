#pragma once

#include <string>

#include "benchmarks/json_fwd.h"

namespace benchmarks {

// The value at a JSON pointer as text, a string without its quotes; empty where it is absent.
std::string textAt(const Json& document, const char* pointer);

}  // namespace benchmarks
