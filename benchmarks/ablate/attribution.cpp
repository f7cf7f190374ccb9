#include "benchmarks/ablate/attribution.h"

#include <array>
#include <cmath>

#include "benchmarks/decide/signed_rank.h"
#include "benchmarks/statistics.h"

namespace benchmarks {

namespace {

constexpr double kAlpha = 0.05;

// A stop's times, each with a factor.
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
    const MedianInterval interval = signedRankInterval(differences, kAlpha);
    Cost cost{.estimate = interval.estimate, .interval = {}};
    if (std::isfinite(interval.lower) && std::isfinite(interval.upper))
        cost.interval = {interval.lower, interval.upper, interval.confidence};
    return cost;
}

Attribution attribute(std::span<const StopTimes> stops) {
    Attribution attribution{
        .rungs = {},
        .pass_time = summarize(lapTimes(stops, Stop::pass)).median,
        .clipped_time = summarize(lapTimes(stops, Stop::clipped)).median,
        .residual = residualOf(stops),
        .watching = {}};
    std::optional<Stop> below;
    for (const StopTimes& each : stops) {
        if (!isRung(each.stop)) continue;
        const std::vector<double> times = lapTimes(stops, each.stop);
        RungCost rung{.stop = each.stop, .time = summarize(times).median, .marginal = {}};
        rung.marginal = below ? difference(stops, each.stop, *below) : costOf(times);
        rung.share = rung.marginal.estimate / attribution.pass_time;
        attribution.rungs.push_back(rung);
        below = each.stop;
    }
    for (const Stop stop : {Stop::watched_vertex, Stop::watched_evaluation, Stop::watched_geometry})
        attribution.watching.emplace_back(stop, difference(stops, stop, Stop::fragment));
    return attribution;
}

}  // namespace benchmarks
