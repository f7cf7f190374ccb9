#include "benchmarks/measure/assessment.h"

#include <cmath>

#include "benchmarks/decide/median_interval.h"
#include "benchmarks/decide/steady_state.h"
#include "benchmarks/measure/settling.h"
#include "benchmarks/statistics.h"

namespace benchmarks {

namespace {

constexpr double kAlpha = 0.05;  // of the interval

}  // namespace

Assessment assess(const RoundTimes& rounds) {
    Assessment result{.settling = settlingRounds(roundLevels(rounds))};
    const RoundTimes kept(
        rounds.begin() + static_cast<std::ptrdiff_t>(result.settling), rounds.end());
    const std::vector<double> times = allTimes(kept);
    const std::vector<double> relative = withoutProfile(kept);
    const SteadyRule rule;
    const bool comparable = kept.size() > 1;  // a single round has nothing to compare frames with
    if (comparable && relative.size() >= rule.window) result.steady = isSteady(relative, rule);
    result.median = quantile(times, 0.5);
    const double width = relativeHalfWidth(
        medianInterval(times, kAlpha, effectiveSamples(comparable ? relative : times)));
    if (std::isfinite(width)) result.relative_half_width = width;
    return result;
}

bool isEnough(const Assessment& assessment, double precision) {
    return precision > 0.0 && assessment.steady.value_or(false) &&
           assessment.relative_half_width.has_value() &&
           *assessment.relative_half_width <= precision;
}

}  // namespace benchmarks
