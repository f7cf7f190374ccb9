#include "benchmarks/decide/median_interval.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "benchmarks/statistics.h"

namespace benchmarks {
namespace {

// Of n independent samples so many may be cut off at either end, and with what confidence the
// median is then inside: 1 - 2 P(Binomial(n, 1/2) < cut).
struct Cut {
    std::size_t count = 0;
    double confidence = 1.0;
};

Cut largestCut(std::size_t n, double alpha) {
    const auto size = static_cast<double>(n);
    Cut cut;
    double log_probability = -size * std::log(2.0);  // of exactly cut.count below the median
    double below = 0.0;
    while (2 * cut.count + 2 <= n) {
        below += std::exp(log_probability);
        if (2.0 * below > alpha) break;
        const auto drawn = static_cast<double>(cut.count);
        log_probability += std::log((size - drawn) / (drawn + 1.0));
        ++cut.count;
        cut.confidence = 1.0 - 2.0 * below;
    }
    return cut;
}

}  // namespace

MedianInterval medianInterval(std::span<const double> samples, double alpha, double effective) {
    const double infinity = std::numeric_limits<double>::infinity();
    MedianInterval interval{quantile(samples, 0.5), -infinity, infinity, 1.0};
    const auto size = static_cast<double>(samples.size());
    effective = std::clamp(std::floor(effective), 1.0, size);
    const Cut cut = largestCut(static_cast<std::size_t>(effective), alpha);
    // Ranks count from 1: cut.count is at this share of the way from the middle to the ends.
    const double middle = 0.5 * (size + 1.0);
    const double share =
        (0.5 * (effective + 1.0) - static_cast<double>(cut.count)) / (0.5 * effective);
    const double rank = std::floor(middle - share * 0.5 * size + 1e-9);  // whole but for rounding
    if (cut.count == 0 || rank < 1.0) return interval;
    std::vector<double> sorted(samples.begin(), samples.end());
    std::ranges::sort(sorted);
    const auto below = static_cast<std::size_t>(rank) - 1;
    interval.lower = sorted[below];
    interval.upper = sorted[sorted.size() - 1 - below];
    interval.confidence = cut.confidence;
    return interval;
}

MedianInterval medianInterval(std::span<const double> samples, double alpha) {
    return medianInterval(samples, alpha, static_cast<double>(samples.size()));
}

double effectiveSamples(std::span<const double> samples) {
    const std::size_t n = samples.size();
    const double median = quantile(samples, 0.5);
    std::vector<double> side;  // a median splits evenly: the mean of these is about 0
    double variance = 0.0;
    for (const double value : samples) {
        side.push_back(value > median ? 1.0 : value < median ? -1.0 : 0.0);
        variance += side.back() * side.back();
    }
    const auto size = static_cast<double>(n);
    if (variance == 0.0) return size;  // all the same: nothing to be dependent
    const auto correlation = [&](std::size_t lag) {
        double sum = 0.0;
        for (std::size_t i = lag; i < n; ++i) sum += side[i] * side[i - lag];
        return sum / variance;
    };
    // Sums of two neighbours are positive and fall for a reversible process; noise ends that.
    double time = -1.0;
    double previous = std::numeric_limits<double>::infinity();
    for (std::size_t lag = 0; lag + 1 < n; lag += 2) {
        const double pair = correlation(lag) + correlation(lag + 1);
        if (pair <= 0.0) break;
        previous = std::min(previous, pair);
        time += 2.0 * previous;
    }
    return std::clamp(size / std::max(time, 1.0), 1.0, size);
}

double relativeHalfWidth(const MedianInterval& interval) {
    if (interval.estimate == 0.0) return std::numeric_limits<double>::infinity();
    return 0.5 * (interval.upper - interval.lower) / std::abs(interval.estimate);
}

bool isPrecise(std::span<const double> samples, const PrecisionRule& rule) {
    if (samples.empty()) return false;
    return relativeHalfWidth(medianInterval(samples, rule.alpha, effectiveSamples(samples))) <=
           rule.target;
}

}  // namespace benchmarks
