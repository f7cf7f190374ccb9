#pragma once

#include <span>
#include <vector>

#include "benchmarks/ablate/ladder.h"

namespace benchmarks {

// The strands pass at one stop in one walk up the ladder and down again; ms of each frame.
struct Lap {
    std::vector<double> up;
    std::vector<double> down;
};

// The mean of both visits' medians, ms. What drifts evenly adds as much to every stop: they are
// visited evenly round the same moment, the top of the ladder.
double lapTime(const Lap& lap);

struct StopTimes {
    Stop stop = Stop::empty;
    std::vector<Lap> laps;
};

// Of a stop that there is.
std::vector<double> lapTimes(std::span<const StopTimes> stops, Stop stop);
bool hasStop(std::span<const StopTimes> stops, Stop stop);

}  // namespace benchmarks
