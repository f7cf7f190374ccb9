#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/ablate/laps.h"

// From times to costs; docs/ablation.md says what they mean.
namespace benchmarks {

// A difference of times, ms: the Hodges-Lehmann estimate over the laps' differences and its exact
// signed-rank interval.
struct Cost {
    double estimate = 0.0;
    struct Interval {
        double lower;
        double upper;
        double confidence;  // achieved, at least 95 %
    };
    std::optional<Interval> interval;  // absent: fewer than 6 laps
};
Cost costOf(std::span<const double> differences);

struct RungCost {
    Stop stop = Stop::empty;
    double time = 0.0;  // ms, median of the laps
    Cost marginal;  // less the rung below; of the lowest all of it
    double share = 0.0;  // of the whole pass
};

// What the marginal costs leave open. All are sums of times of the same lap.
struct Residual {
    Cost closure;  // the renderer's own pass less all marginal costs
    Cost discard;  // clipped less geometry: two ways to end before the rasteriser
    std::optional<Cost> multisampling;  // what samples cost with a fragment shader less without
    Cost interaction;  // the sum of these: the pass less costs measured in another order
};

struct Attribution {
    std::vector<RungCost> rungs;  // from the bottom up
    double pass_time = 0.0;  // ms, median, of the renderer's own
    double clipped_time = 0.0;
    Residual residual;
    std::vector<std::pair<Stop, Cost>> watching;  // what it costs that a stage is watched
};

// `stops` are those of planStops(), with as many laps each, at least one.
Attribution attribute(std::span<const StopTimes> stops);

// What speaks against believing it.
std::vector<std::string> attributionWarnings(const Attribution& attribution);

}  // namespace benchmarks
