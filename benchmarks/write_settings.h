#pragma once

#include "benchmarks/json_fwd.h"
#include "hair/settings.h"

namespace benchmarks {

// Every field, resolved: the inverse of readSettings. A float is written as the shortest decimal
// that reads back bit-equal.
Json writeSettings(const hair::Settings& settings);

}  // namespace benchmarks
