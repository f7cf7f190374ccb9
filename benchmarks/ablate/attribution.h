#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/ablate/stops.h"

// From times to costs; docs/measuring.md says what they mean.
namespace benchmarks::ablate {

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

// Warnings about an attribution that is not to be believed.
std::vector<std::string> attributionWarnings(const Attribution& attribution);

// Counts of work in one picture. What is not known is absent.
struct WorkCounts {
    std::optional<std::uint64_t> patches;
    std::optional<std::uint64_t> strands;
    std::optional<std::uint64_t> segments;  // drawn
    std::optional<std::uint64_t> evaluations_1;  // at one segment a guide segment
    std::optional<std::uint64_t> evaluations;
    std::optional<std::uint64_t> fragments;  // at one sample
    std::optional<std::uint64_t> samples;  // with the case's, above 1
    std::string fragments_note;  // empty: exact
};

// A rung's marginal cost per thing that it does more than the rung below, or over which it is
// spread.
struct UnitCost {
    Stop rung = Stop::empty;
    std::string unit;  // "strand", "segment", "patch", "evaluation", "fragment", "sample"
    std::uint64_t count = 0;
    double nanoseconds = 0.0;
    std::string note;  // empty: the count is exact
};

// Per strand and segment for all but the empty rung, and per what the stage handles.
std::vector<UnitCost> unitCosts(const std::vector<RungCost>& rungs, const WorkCounts& work);

}  // namespace benchmarks::ablate
