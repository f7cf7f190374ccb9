#include "benchmarks/decide/steady_state.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "benchmarks/statistics.h"
#include "engine/error.h"

namespace benchmarks {
namespace {

constexpr std::size_t kMostExact = 33;

// P(so many inversions) of a random order of n, counted from 0: the n-th thing may stand before
// 0 ... n - 1 of the others.
std::vector<double> inversionProbabilities(std::size_t n) {
    std::vector<double> probabilities{1.0};
    for (std::size_t i = 2; i <= n; ++i) {
        std::vector<double> next(probabilities.size() + i - 1, 0.0);
        for (std::size_t count = 0; count < probabilities.size(); ++count)
            for (std::size_t more = 0; more < i; ++more)
                next[count + more] += probabilities[count] / static_cast<double>(i);
        probabilities = std::move(next);
    }
    return probabilities;
}

double exactP(std::size_t n, double score) {
    const std::vector<double> probabilities = inversionProbabilities(n);
    const auto pairs = static_cast<double>(probabilities.size() - 1);
    const auto fewest = static_cast<std::size_t>(std::lround(0.5 * (pairs - std::abs(score))));
    double tail = 0.0;
    for (std::size_t count = 0; count <= fewest; ++count) tail += probabilities[count];
    return std::min(1.0, 2.0 * tail);
}

// Sums over the groups of t equal samples.
struct Ties {
    double pairs = 0.0;   // t (t - 1)
    double spread = 0.0;  // t (t - 1) (2 t + 5)
};

Ties tiesOf(std::span<const double> samples) {
    std::map<double, double> sizes;
    for (const double sample : samples) ++sizes[sample];
    Ties ties;
    for (const auto& [value, t] : sizes) {
        ties.pairs += t * (t - 1.0);
        ties.spread += t * (t - 1.0) * (2.0 * t + 5.0);
    }
    return ties;
}

}  // namespace

Trend trend(std::span<const double> samples) {
    double score = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i)
        for (std::size_t j = i + 1; j < samples.size(); ++j)
            score += samples[j] > samples[i] ? 1.0 : samples[j] < samples[i] ? -1.0 : 0.0;
    const Ties ties = tiesOf(samples);
    const auto n = static_cast<double>(samples.size());
    if (samples.size() < 2 || ties.pairs == n * (n - 1.0)) return {score, 1.0};
    if (samples.size() <= kMostExact && ties.pairs == 0.0)
        return {score, exactP(samples.size(), score)};
    // Time has no ties, so the terms for ties in both orders vanish.
    const double variance = (n * (n - 1.0) * (2.0 * n + 5.0) - ties.spread) / 18.0;
    return {score, std::erfc(std::abs(score) / std::sqrt(variance) / std::numbers::sqrt2)};
}

double medianSlope(std::span<const double> samples) {
    if (samples.size() < 2) throw engine::Error("median slope", "fewer than two samples");
    std::vector<double> slopes;
    for (std::size_t i = 0; i < samples.size(); ++i)
        for (std::size_t j = i + 1; j < samples.size(); ++j)
            slopes.push_back((samples[j] - samples[i]) / static_cast<double>(j - i));
    return quantile(slopes, 0.5);
}

bool isSteady(std::span<const double> samples, const SteadyRule& rule) {
    if (samples.size() < std::max<std::size_t>(rule.window, 1)) return false;
    const std::span<const double> window = samples.last(rule.window);
    if (trend(window).p > rule.level) return true;
    const double drift = std::abs(medianSlope(window)) * static_cast<double>(rule.window - 1);
    return drift <= rule.tolerance * std::abs(quantile(window, 0.5));
}

}  // namespace benchmarks
