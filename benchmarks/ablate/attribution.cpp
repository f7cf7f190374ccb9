#include "benchmarks/ablate/attribution.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "benchmarks/report/statistics.h"
#include "benchmarks/report/text.h"

namespace benchmarks::ablate {
namespace {

// ---- Marginal costs and residuals ---------------------------------------------------------------

constexpr double kAlpha = 0.05;

// A stop's times with a factor.
struct Term {
    Stop stop;
    double factor;
};

Cost sumOf(std::span<const StopTimes> stops, std::span<const Term> terms) {
    std::vector<double> sums(stops.front().laps.size(), 0.0);
    for (const Term& term : terms) {
        const std::vector<double> times = lapTimes(stops, term.stop);
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += term.factor * times[i];
    }
    return costOf(sums);
}

Cost difference(std::span<const StopTimes> stops, Stop with, Stop without) {
    return sumOf(stops, std::array{Term{with, 1.0}, Term{without, -1.0}});
}

Residual residualOf(std::span<const StopTimes> stops) {
    const bool multisampled = hasStop(stops, Stop::msaa);
    const Stop top = multisampled ? Stop::msaa : Stop::fragment;
    Residual residual{
        .closure = difference(stops, Stop::pass, top),
        .discard = difference(stops, Stop::clipped, Stop::geometry),
        .multisampling = {},
        .interaction = {}};
    const std::array samples{
        Term{Stop::msaa, 1.0}, Term{Stop::fragment, -1.0}, Term{Stop::raster_msaa, -1.0},
        Term{Stop::raster, 1.0}};
    std::vector<Term> all{
        {Stop::pass, 1.0}, {top, -1.0}, {Stop::clipped, 1.0}, {Stop::geometry, -1.0}};
    if (multisampled) {
        residual.multisampling = sumOf(stops, samples);
        all.insert(all.end(), samples.begin(), samples.end());
    }
    residual.interaction = sumOf(stops, all);
    return residual;
}

}  // namespace

Cost costOf(std::span<const double> differences) {
    const report::MedianInterval interval = report::signedRankInterval(differences, kAlpha);
    Cost cost{.estimate = interval.estimate, .interval = {}};
    if (std::isfinite(interval.lower) && std::isfinite(interval.upper))
        cost.interval = {interval.lower, interval.upper, interval.confidence};
    return cost;
}

Attribution attribute(std::span<const StopTimes> stops) {
    Attribution attribution{
        .rungs = {},
        .pass_time = report::summarize(lapTimes(stops, Stop::pass)).median,
        .clipped_time = report::summarize(lapTimes(stops, Stop::clipped)).median,
        .residual = residualOf(stops),
        .watching = {}};
    std::optional<Stop> below;
    for (const StopTimes& each : stops) {
        if (!isRung(each.stop)) continue;
        const std::vector<double> times = lapTimes(stops, each.stop);
        RungCost rung{.stop = each.stop, .time = report::summarize(times).median, .marginal = {}};
        rung.marginal = below ? difference(stops, each.stop, *below) : costOf(times);
        rung.share = rung.marginal.estimate / attribution.pass_time;
        attribution.rungs.push_back(rung);
        below = each.stop;
    }
    for (const Stop stop : {Stop::watched_vertex, Stop::watched_evaluation, Stop::watched_geometry})
        attribution.watching.emplace_back(stop, difference(stops, stop, Stop::fragment));
    return attribution;
}

namespace {

// ---- Warnings -----------------------------------------------------------------------------------

constexpr double kDiscardTolerance = 0.1;  // share of the geometry rung's time
constexpr double kClosureTolerance = 0.02;  // share of the pass's time; a smaller change is
                                            // irrelevant
constexpr double kWatchTolerance = 0.1;  // share of the stage's cost
constexpr double kWatchShare = 0.01;  // share of the pass's time: with many comparisons, some
                                      // exceed the limit by chance

// True if the whole interval is outside -limit ... limit; false with too few laps for an interval.
bool isBeyond(const Cost& cost, double limit) {
    return cost.interval && (cost.interval->lower > limit || cost.interval->upper < -limit);
}

std::string text(const Cost& cost) {
    std::string text = report::shortNumber(cost.estimate) + " ms";
    if (cost.interval)
        text += " (" + report::shortNumber(cost.interval->lower) + " to " +
                report::shortNumber(cost.interval->upper) + ')';
    return text;
}

// Sum of the marginal costs of these rungs.
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
                ": the driver omits or adds work in one of them, so that the costs before and "
                "after the rasteriser are uncertain by as much");
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
                ", over a tenth of the stage's " + report::shortNumber(stage) + " ms");
    }
    return warnings;
}

namespace {

// ---- Costs per strand, segment, fragment --------------------------------------------------------

struct Unit {
    const char* name;
    std::optional<std::uint64_t> count;
    std::string note{};
};

// The unit of work of a stage.
Unit ownUnit(Stop rung, const WorkCounts& work) {
    switch (rung) {
    case Stop::vertex:
        return {"patch", work.patches};
    case Stop::tessellation_1:
        return {"evaluation", work.evaluations_1};
    case Stop::tessellation:
        if (!work.evaluations) break;
        return {"evaluation", *work.evaluations - work.evaluations_1.value_or(0)};
    case Stop::raster:
    case Stop::fragment:
        return {"fragment", work.fragments, work.fragments_note};
    case Stop::msaa:
        return {"sample", work.samples};
    default:
        break;
    }
    return {"", std::nullopt};
}

}  // namespace

std::vector<UnitCost> unitCosts(const std::vector<RungCost>& rungs, const WorkCounts& work) {
    std::vector<UnitCost> costs;
    for (const RungCost& rung : rungs) {
        if (rung.stop == Stop::empty) continue;
        for (const Unit& unit :
             {Unit{"strand", work.strands}, Unit{"segment", work.segments},
              ownUnit(rung.stop, work)}) {
            if (unit.count.value_or(0) == 0) continue;
            const double each = 1e6 * rung.marginal.estimate / static_cast<double>(*unit.count);
            costs.push_back({rung.stop, unit.name, *unit.count, each, unit.note});
        }
    }
    return costs;
}

}  // namespace benchmarks::ablate
