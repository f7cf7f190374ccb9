#include "benchmarks/compare/median_ratio.h"

#include <cmath>
#include <limits>
#include <vector>

#include "benchmarks/decide/median_interval.h"
#include "benchmarks/decide/multiple_tests.h"

namespace benchmarks {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSmallestLevel = 1e-9;  // below it nobody asks

// Samples with what their number is worth, which takes long to find out.
struct Sample {
    std::span<const double> values;
    double effective;
};

Sample sampleOf(std::span<const double> values) { return {values, effectiveSamples(values)}; }

RatioInterval ratioInterval(const Sample& a, const Sample& b, double alpha) {
    const MedianInterval of_a = medianInterval(a.values, alpha / 2.0, a.effective);
    const MedianInterval of_b = medianInterval(b.values, alpha / 2.0, b.effective);
    if (!(of_a.lower > 0.0) || !(of_b.lower > 0.0) || !std::isfinite(of_a.upper) ||
        !std::isfinite(of_b.upper))
        return {-kInfinity, kInfinity};
    return {std::log(of_b.lower / of_a.upper), std::log(of_b.upper / of_a.lower)};
}

bool isOutside(const RatioInterval& interval, double bound) {
    return interval.lower > bound || interval.upper < -bound;
}

// The interval only grows as the level falls.
double smallestLevel(const Sample& a, const Sample& b, double bound) {
    double outside = 1.0;
    if (!isOutside(ratioInterval(a, b, outside), bound)) return 1.0;
    double inside = kSmallestLevel;
    if (isOutside(ratioInterval(a, b, inside), bound)) return inside;
    while (outside > 1.01 * inside) {
        const double level = std::sqrt(inside * outside);
        (isOutside(ratioInterval(a, b, level), bound) ? outside : inside) = level;
    }
    return outside;
}

}  // namespace

RatioInterval
medianRatioInterval(std::span<const double> a, std::span<const double> b, double alpha) {
    return ratioInterval(sampleOf(a), sampleOf(b), alpha);
}

Comparison compareMedians(
    std::span<const double> a, std::span<const double> b, double decisive_change, double alpha) {
    const Sample sample_a = sampleOf(a);
    const Sample sample_b = sampleOf(b);
    const RatioInterval interval = ratioInterval(sample_a, sample_b, alpha);
    const double middle_a = medianInterval(a, alpha).estimate;
    const double middle_b = medianInterval(b, alpha).estimate;
    return {
        .verdict = Verdict::inconclusive,
        .change = middle_a > 0.0 ? middle_b / middle_a - 1.0 : 0.0,
        .lower = std::expm1(interval.lower),
        .upper = std::expm1(interval.upper),
        .decisive_change = decisive_change,
        .p = smallestLevel(sample_a, sample_b, std::log1p(decisive_change))};
}

void passVerdicts(std::span<Comparison> comparisons, double alpha) {
    std::vector<double> p_values;
    for (const Comparison& each : comparisons) p_values.push_back(each.p);
    const std::vector<double> adjusted = falseDiscoveryAdjusted(p_values);
    for (std::size_t i = 0; i < comparisons.size(); ++i) {
        Comparison& each = comparisons[i];
        each.p = adjusted[i];
        const double bound = std::log1p(each.decisive_change);
        if (each.p <= alpha)
            each.verdict = each.change > 0.0 ? Verdict::regressed : Verdict::improved;
        else if (std::log1p(each.lower) > -bound && std::log1p(each.upper) < bound)
            each.verdict = Verdict::same;
        else
            each.verdict = Verdict::inconclusive;
    }
}

}  // namespace benchmarks
