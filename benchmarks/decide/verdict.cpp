#include "benchmarks/decide/verdict.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "benchmarks/decide/multiple_tests.h"
#include "benchmarks/statistics.h"

namespace benchmarks {
namespace {

constexpr double kNormalDeviations = 1.4826;  // a normal distribution's sigma over its MAD

bool isAbove(std::span<const double> differences, double bound) {
    return signedRankP(differences, bound).greater <= signedRankP(differences, -bound).less;
}

// Twice the smaller one-sided p: that the median is above the band, or below it.
double outsideP(std::span<const double> differences, double bound) {
    const double above = signedRankP(differences, bound).greater;
    const double below = signedRankP(differences, -bound).less;
    return std::min(1.0, 2.0 * std::min(above, below));
}

Verdict verdictOf(
    std::span<const double> differences, const MedianInterval& interval, double bound,
    double adjusted_p, double level) {
    if (adjusted_p <= level)
        return isAbove(differences, bound) ? Verdict::regressed : Verdict::improved;
    if (interval.lower > -bound && interval.upper < bound) return Verdict::same;
    return Verdict::inconclusive;
}

}  // namespace

const char* verdictName(Verdict verdict) {
    switch (verdict) {
    case Verdict::regressed:
        return "regressed";
    case Verdict::improved:
        return "improved";
    case Verdict::same:
        return "same";
    case Verdict::inconclusive:
        return "inconclusive";
    case Verdict::mismatch:
        return "mismatch";
    }
    return "inconclusive";
}

double decisiveChange(double threshold, std::span<const double> calibration) {
    if (calibration.empty()) return threshold;
    return std::max(threshold, 3.0 * kNormalDeviations * summarize(calibration).mad);
}

std::vector<Comparison> compare(
    std::span<const std::vector<double>> differences, std::span<const double> decisive_changes,
    double alpha) {
    assert(differences.size() == decisive_changes.size());
    const double level = stageLevel(alpha);
    std::vector<double> p_values;
    for (std::size_t i = 0; i < differences.size(); ++i)
        p_values.push_back(outsideP(differences[i], std::log1p(decisive_changes[i])));
    const std::vector<double> adjusted = falseDiscoveryAdjusted(p_values);
    std::vector<Comparison> comparisons;
    for (std::size_t i = 0; i < differences.size(); ++i) {
        const double bound = std::log1p(decisive_changes[i]);
        const MedianInterval interval = signedRankInterval(differences[i], level);
        comparisons.push_back(
            {.verdict = verdictOf(differences[i], interval, bound, adjusted[i], level),
             .change = std::expm1(interval.estimate),
             .lower = std::expm1(interval.lower),
             .upper = std::expm1(interval.upper),
             .decisive_change = decisive_changes[i],
             .p = adjusted[i]});
    }
    return comparisons;
}

}  // namespace benchmarks
