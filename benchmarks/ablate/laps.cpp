#include "benchmarks/ablate/laps.h"

#include <algorithm>
#include <cassert>

#include "benchmarks/statistics.h"

namespace benchmarks {

double lapTime(const Lap& lap) {
    return 0.5 * (summarize(lap.up).median + summarize(lap.down).median);
}

std::vector<double> lapTimes(std::span<const StopTimes> stops, Stop stop) {
    const auto found = std::ranges::find(stops, stop, &StopTimes::stop);
    assert(found != stops.end());
    std::vector<double> times;
    for (const Lap& lap : found->laps) times.push_back(lapTime(lap));
    return times;
}

bool hasStop(std::span<const StopTimes> stops, Stop stop) {
    return std::ranges::find(stops, stop, &StopTimes::stop) != stops.end();
}

}  // namespace benchmarks
