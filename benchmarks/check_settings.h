#pragma once

#include "hair/settings.h"

namespace benchmarks {

// The rules between fields, which no table row can say, such as a near plane in front of the far
// plane. A broken one is an engine::Error "<JSON pointer>: <reason>".
void checkSettings(const hair::Settings& settings);

}  // namespace benchmarks
