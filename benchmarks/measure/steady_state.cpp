#include "benchmarks/measure/steady_state.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <vector>

#include "benchmarks/report/statistics.h"
#include "engine/error.h"

namespace benchmarks::measure {
namespace {

// ---- Trend of a series --------------------------------------------------------------------------

constexpr std::size_t kMostExact = 33;

// Probabilities of the number of inversions of a random order of n, from 0 up. The n-th item may
// stand before 0 ... n - 1 of the others.
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
    double pairs = 0.0;  // t (t - 1)
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
    return report::quantile(slopes, 0.5);
}

bool isSteady(std::span<const double> samples, const SteadyRule& rule) {
    if (samples.size() < std::max<std::size_t>(rule.window, 1)) return false;
    const std::span<const double> window = samples.last(rule.window);
    if (trend(window).p > rule.level) return true;
    const double drift = std::abs(medianSlope(window)) * static_cast<double>(rule.window - 1);
    return drift <= rule.tolerance * std::abs(report::quantile(window, 0.5));
}

// ---- Times relative to their frame --------------------------------------------------------------

std::vector<double> withoutProfile(const RoundTimes& rounds) {
    std::vector<double> relative = allTimes(rounds);
    if (rounds.empty()) return relative;
    const std::size_t frames = rounds.front().size();
    for (std::size_t frame = 0; frame < frames; ++frame) {
        std::vector<double> same;
        for (const std::vector<double>& round : rounds) same.push_back(round[frame]);
        const double usual = report::quantile(same, 0.5);
        // Times of 0 are below the clock's resolution and count as equal.
        for (std::size_t i = frame; i < relative.size(); i += frames)
            relative[i] = usual > 0.0 ? relative[i] / usual : 1.0;
    }
    return relative;
}

std::vector<double> roundLevels(const RoundTimes& rounds) {
    const std::vector<double> relative = withoutProfile(rounds);
    std::vector<double> levels;
    for (std::size_t i = 0; i < rounds.size(); ++i) {
        const std::size_t frames = rounds[i].size();
        levels.push_back(report::quantile(std::span(relative).subspan(i * frames, frames), 0.5));
    }
    return levels;
}

std::vector<double> allTimes(std::span<const std::vector<double>> rounds) {
    std::vector<double> times;
    for (const std::vector<double>& round : rounds)
        times.insert(times.end(), round.begin(), round.end());
    return times;
}

namespace {

// ---- Rounds that still settle -------------------------------------------------------------------

constexpr std::size_t kShortest = 8;  // 2 / 8! is below any share of the level
constexpr std::size_t kMostBlocks = 64;  // the tests take time cubic in this
constexpr std::size_t kHeads[] = {2, 3, 4};

using Levels = std::span<const double>;

bool areOff(Levels some, Levels others, double tolerance) {
    const double usual = report::quantile(others, 0.5);
    return std::abs(report::quantile(some, 0.5) - usual) > tolerance * std::abs(usual);
}

bool hasTrend(Levels levels, double level, double tolerance) {
    const std::size_t quarter = std::max<std::size_t>(levels.size() / 4, 1);
    return trend(levels).p <= level &&
           areOff(levels.first(quarter), levels.last(quarter), tolerance);
}

double binomial(std::size_t n, std::size_t k) {
    double ways = 1.0;
    for (std::size_t i = 1; i <= k; ++i)
        ways *= static_cast<double>(n - k + i) / static_cast<double>(i);
    return ways;
}

bool standsApart(Levels levels, std::size_t head, double level, double tolerance) {
    const Levels first = levels.first(head);
    const Levels rest = levels.subspan(head);
    const bool apart = std::ranges::min(first) > std::ranges::max(rest) ||
                       std::ranges::max(first) < std::ranges::min(rest);
    return apart && 2.0 / binomial(levels.size(), head) <= level && areOff(first, rest, tolerance);
}

bool settles(Levels levels, const SettlingRule& rule) {
    std::vector<std::size_t> stretches;
    for (std::size_t length = kShortest; length < levels.size(); length *= 2)
        stretches.push_back(length);
    stretches.push_back(levels.size());
    const double level = rule.level / static_cast<double>(stretches.size() + std::size(kHeads));
    return std::ranges::any_of(
               stretches,
               [&](std::size_t length) {
                   return hasTrend(levels.first(length), level, rule.tolerance);
               }) ||
           std::ranges::any_of(kHeads, [&](std::size_t head) {
               return standsApart(levels, head, level, rule.tolerance);
           });
}

}  // namespace

std::size_t settlingRounds(std::span<const double> levels, const SettlingRule& rule) {
    const std::size_t size = (levels.size() + kMostBlocks - 1) / kMostBlocks;  // rounds per block
    std::vector<double> blocks;
    for (std::size_t i = 0; size > 0 && i + size <= levels.size(); i += size)
        blocks.push_back(report::quantile(levels.subspan(i, size), 0.5));
    for (std::size_t left_out = 0;
         left_out <= blocks.size() / 2 && blocks.size() - left_out >= kShortest; ++left_out)
        if (!settles(std::span(blocks).subspan(left_out), rule)) return left_out * size;
    return 0;
}

namespace {

// ---- Assessment ---------------------------------------------------------------------------------

constexpr double kAlpha = 0.05;  // of the interval

// With a single round, frames have no counterpart to compare with.
bool isComparable(const RoundTimes& rounds) { return rounds.size() > 1; }

// Half of the median's interval over the median; infinite if there are too few times.
double halfWidth(const RoundTimes& rounds) {
    const std::vector<double> times = allTimes(rounds);
    return report::relativeHalfWidth(report::medianInterval(
        times, kAlpha,
        report::effectiveSamples(isComparable(rounds) ? withoutProfile(rounds) : times)));
}

}  // namespace

Assessment assess(const RoundTimes& rounds, std::span<const RoundTimes> parts) {
    Assessment result{.settling = settlingRounds(roundLevels(rounds))};
    const RoundTimes kept(
        rounds.begin() + static_cast<std::ptrdiff_t>(result.settling), rounds.end());
    const std::vector<double> relative = withoutProfile(kept);
    const SteadyRule rule;
    if (isComparable(kept) && relative.size() >= rule.window)
        result.steady = isSteady(relative, rule);
    result.median = report::quantile(allTimes(kept), 0.5);
    double width = halfWidth(kept);
    for (const RoundTimes& part : parts) {
        const RoundTimes kept_part(
            part.begin() + static_cast<std::ptrdiff_t>(result.settling), part.end());
        if (report::quantile(allTimes(kept_part), 0.5) >= kLeastPart * result.median)
            width = std::max(width, halfWidth(kept_part));
    }
    if (std::isfinite(width)) result.relative_half_width = width;
    return result;
}

bool isEnough(const Assessment& assessment, double precision) {
    return precision > 0.0 && assessment.steady.value_or(false) &&
           assessment.relative_half_width.has_value() &&
           *assessment.relative_half_width <= precision;
}

}  // namespace benchmarks::measure
