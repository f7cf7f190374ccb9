#include <algorithm>
#include <array>
#include <cmath>

#include "benchmarks/ablate/attribution.h"
#include "benchmarks/table.h"

namespace benchmarks {

namespace {

constexpr double kDiscardTolerance = 0.1;  // of the geometry rung
constexpr double kClosureTolerance = 0.02;  // of the pass: a change of this share matters to nobody
constexpr double kWatchTolerance = 0.1;  // of what its stage costs
constexpr double kWatchShare = 0.01;  // of the pass: with many comparisons some are off by chance

// Whether all of the interval is beyond -limit ... limit; never with too few laps for one.
bool isBeyond(const Cost& cost, double limit) {
    return cost.interval && (cost.interval->lower > limit || cost.interval->upper < -limit);
}

std::string text(const Cost& cost) {
    std::string text = shortNumber(cost.estimate) + " ms";
    if (cost.interval)
        text += " (" + shortNumber(cost.interval->lower) + " to " +
                shortNumber(cost.interval->upper) + ')';
    return text;
}

// Of one or both rungs of the tessellation.
double marginalOf(const Attribution& attribution, std::span<const Stop> rungs) {
    double sum = 0.0;
    for (const RungCost& rung : attribution.rungs)
        if (std::ranges::find(rungs, rung.stop) != rungs.end()) sum += rung.marginal.estimate;
    return sum;
}

double watchedStage(const Attribution& attribution, Stop watched) {
    if (watched == Stop::watched_vertex) return marginalOf(attribution, std::array{Stop::vertex});
    if (watched == Stop::watched_evaluation)
        return marginalOf(attribution, std::array{Stop::tessellation_1, Stop::tessellation});
    return marginalOf(attribution, std::array{Stop::geometry});
}

}  // namespace

std::vector<std::string> attributionWarnings(const Attribution& attribution) {
    std::vector<std::string> warnings;
    const Residual& residual = attribution.residual;
    for (const RungCost& rung : attribution.rungs) {
        if (rung.marginal.interval && rung.marginal.interval->upper < 0.0)
            warnings.push_back(
                std::string(stopName(rung.stop)) + ": the pass takes less with it than without, " +
                text(rung.marginal));
        if (rung.stop == Stop::geometry &&
            isBeyond(residual.discard, kDiscardTolerance * rung.time))
            warnings.push_back(
                "discarding primitives and clipping all of them differ by " +
                text(residual.discard) +
                ": the driver leaves work away or does more in one of them, so that the costs "
                "before and after the rasteriser are uncertain by as much");
    }
    if (isBeyond(residual.closure, kClosureTolerance * attribution.pass_time))
        warnings.push_back(
            "the pass differs from the top of the ladder, which draws the same, by " +
            text(residual.closure));
    for (const auto& [watched, cost] : attribution.watching) {
        const double stage = std::max(watchedStage(attribution, watched), 0.0);
        const double limit = std::max(kWatchTolerance * stage, kWatchShare * attribution.pass_time);
        if (cost.interval && cost.interval->lower > limit)
            warnings.push_back(
                std::string(stopName(watched)) + ": watching costs " + text(cost) +
                ", over a tenth of the stage's " + shortNumber(stage) + " ms");
    }
    return warnings;
}

}  // namespace benchmarks
