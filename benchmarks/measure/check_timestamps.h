#pragma once

#include <string>
#include <vector>

#include "benchmarks/measure/round_player.h"

namespace benchmarks {

// Plays isolated frames and frames whose passes are submitted and waited for one at a time, in
// turns, and returns what timestampFaults() (trust.h) finds. A fault of the device stays, a
// disturbance passes: while there are faults more pairs are drawn, up to 16.
std::vector<std::string> checkTimestamps(const Play& play);

}  // namespace benchmarks
