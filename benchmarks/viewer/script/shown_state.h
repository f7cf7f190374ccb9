#pragma once

#include "benchmarks/json_fwd.h"
#include "benchmarks/viewer/script/driver.h"

namespace benchmarks {

// What the window shows: its size in px, the scale of its letters, what it says, each side's frame,
// hashes and settings, and every widget of the last picture.
Json shownState(const Driver& driver);

}  // namespace benchmarks
