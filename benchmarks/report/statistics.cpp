#include "benchmarks/report/statistics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "engine/error.h"

namespace benchmarks::report {
namespace {

// ---- Order statistics and rates -----------------------------------------------------------------

constexpr double kMillisecondsPerSecond = 1000.0;

template <class Order = std::less<>>
std::vector<double> sorted(std::span<const double> samples, Order order = {}) {
    if (samples.empty()) throw engine::Error("statistics", "no samples");
    std::vector<double> copy(samples.begin(), samples.end());
    std::ranges::sort(copy, order);
    return copy;
}

double quantileOfSorted(std::span<const double> values, double p) {
    const double position = static_cast<double>(values.size() - 1) * std::clamp(p, 0.0, 1.0);
    const auto below = static_cast<std::size_t>(position);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return std::lerp(values[below], values[above], position - static_cast<double>(below));
}

double sum(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

double relativeDeviation(std::span<const double> values, double mean) {
    double squares = 0.0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    if (squares == 0.0) return 0.0;
    const double deviation = std::sqrt(squares / static_cast<double>(values.size() - 1));
    return mean == 0.0 ? std::numeric_limits<double>::infinity() : deviation / std::abs(mean);
}

}  // namespace

Summary summarize(std::span<const double> samples) {
    const std::vector<double> values = sorted(samples);
    const double median = quantileOfSorted(values, 0.5);
    const double mean = sum(values) / static_cast<double>(values.size());
    std::vector<double> deviations = values;
    for (double& value : deviations) value = std::abs(value - median);
    return {
        .count = values.size(),
        .minimum = values.front(),
        .first_quartile = quantileOfSorted(values, 0.25),
        .median = median,
        .third_quartile = quantileOfSorted(values, 0.75),
        .maximum = values.back(),
        .mean = mean,
        .mad = quantileOfSorted(sorted(deviations), 0.5),
        .relative_deviation = relativeDeviation(values, mean)};
}

double quantile(std::span<const double> samples, double p) {
    if (samples.empty()) throw engine::Error("statistics", "no samples");
    // Sorts no more than needed, because there may be hundreds of thousands of frames.
    std::vector<double> values(samples.begin(), samples.end());
    const double position = static_cast<double>(values.size() - 1) * std::clamp(p, 0.0, 1.0);
    const auto below = static_cast<std::size_t>(position);
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(below);
    std::ranges::nth_element(values, at);
    const double above = at + 1 == values.end() ? *at : *std::min_element(at + 1, values.end());
    return std::lerp(*at, above, position - static_cast<double>(below));
}

double framesPerSecond(std::span<const double> frame_ms) {
    if (frame_ms.empty()) throw engine::Error("statistics", "no samples");
    return kMillisecondsPerSecond * static_cast<double>(frame_ms.size()) / sum(frame_ms);
}

LowRates lowRates(std::span<const double> frame_ms, double fraction) {
    const std::vector<double> longest = sorted(frame_ms, std::greater<>{});
    // The tolerance keeps rounding, as in 0.01 * 300 = 3.0000000000000004, from counting a fourth
    // frame.
    const double share = fraction * static_cast<double>(longest.size());
    const auto worst = std::clamp(
        static_cast<std::size_t>(std::ceil(share - 1e-9)), std::size_t{1}, longest.size());
    const double worst_mean = sum(std::span(longest).first(worst)) / static_cast<double>(worst);
    const double budget = fraction * sum(longest);
    std::size_t last = 0;
    for (double spent = longest[0]; spent < budget && last + 1 < longest.size();)
        spent += longest[++last];
    return {
        .percentile = kMillisecondsPerSecond / quantile(frame_ms, 1.0 - fraction),
        .mean = kMillisecondsPerSecond / worst_mean,
        .integral = kMillisecondsPerSecond / longest[last]};
}

namespace {

// ---- Signed-rank test ---------------------------------------------------------------------------

// Returns P(sum = s) of the ranks with a positive sign, if both signs are equally likely. Every
// step is a mean of two earlier probabilities, so there is no cancellation.
std::vector<double> sumProbabilities(std::span<const std::size_t> ranks) {
    const std::size_t most = std::accumulate(ranks.begin(), ranks.end(), std::size_t{0});
    std::vector<double> probabilities(most + 1, 0.0);
    probabilities[0] = 1.0;
    std::vector<double> next(probabilities.size());
    std::size_t reached = 0;
    for (const std::size_t rank : ranks) {
        reached += rank;
        for (std::size_t sum = 0; sum < rank; ++sum) next[sum] = 0.5 * probabilities[sum];
        for (std::size_t sum = rank; sum <= reached; ++sum)
            next[sum] = 0.5 * (probabilities[sum] + probabilities[sum - rank]);
        std::swap(probabilities, next);
    }
    return probabilities;
}

std::vector<double> walshAverages(std::span<const double> values) {
    std::vector<double> averages;
    averages.reserve(values.size() * (values.size() + 1) / 2);
    for (std::size_t i = 0; i < values.size(); ++i)
        for (std::size_t j = i; j < values.size(); ++j)
            averages.push_back(0.5 * values[i] + 0.5 * values[j]);
    std::ranges::sort(averages);
    return averages;
}

void requireDifferences(std::span<const double> differences) {
    if (differences.empty()) throw engine::Error("signed rank", "no differences");
    if (differences.size() > kMostDifferences)
        throw engine::Error(
            "signed rank", "more than " + std::to_string(kMostDifferences) + " differences");
    if (!std::ranges::all_of(differences, [](double value) { return std::isfinite(value); }))
        throw engine::Error("signed rank", "a difference is not finite");
}

// Returns the mean ranks of sorted magnitudes, divided by the largest unit that makes them all
// integers: 1 without ties, often 1/2 with them.
std::vector<std::size_t> meanRanks(std::span<const double> sorted) {
    std::vector<std::size_t> ranks(sorted.size());
    for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
        while (end < sorted.size() && sorted[end] == sorted[begin]) ++end;
        for (std::size_t i = begin; i < end; ++i) ranks[i] = begin + 1 + end;  // twice the mean
    }
    std::size_t unit = 0;
    for (const std::size_t rank : ranks) unit = std::gcd(unit, rank);
    for (std::size_t& rank : ranks) rank /= unit;
    return ranks;
}

}  // namespace

std::vector<double> signedRankDistribution(std::size_t n) {
    std::vector<std::size_t> ranks(n);
    std::iota(ranks.begin(), ranks.end(), std::size_t{1});
    std::vector<double> distribution = sumProbabilities(ranks);
    std::partial_sum(distribution.begin(), distribution.end(), distribution.begin());
    return distribution;
}

MedianInterval signedRankInterval(std::span<const double> differences, double alpha) {
    requireDifferences(differences);
    const std::vector<double> averages = walshAverages(differences);
    const std::vector<double> distribution = signedRankDistribution(differences.size());
    // The number of Walsh averages to cut off at either end.
    std::size_t cut = 0;
    while (2 * cut + 2 < averages.size() && 2.0 * distribution[cut] <= alpha) ++cut;
    MedianInterval interval{
        .estimate = quantile(averages, 0.5),
        .lower = -std::numeric_limits<double>::infinity(),
        .upper = std::numeric_limits<double>::infinity(),
        .confidence = 1.0};
    if (cut == 0) return interval;
    interval.lower = averages[cut - 1];
    interval.upper = averages[averages.size() - cut];
    interval.confidence = 1.0 - 2.0 * distribution[cut - 1];
    return interval;
}

SignedRankP signedRankP(std::span<const double> differences, double median) {
    requireDifferences(differences);
    std::vector<double> shifted;
    for (const double difference : differences)
        if (difference != median) shifted.push_back(difference - median);
    if (shifted.empty()) return {1.0, 1.0, 1.0};
    std::ranges::sort(shifted, {}, [](double value) { return std::abs(value); });
    std::vector<double> magnitudes;
    for (const double value : shifted) magnitudes.push_back(std::abs(value));
    const std::vector<std::size_t> ranks = meanRanks(magnitudes);
    std::size_t positive = 0;
    for (std::size_t i = 0; i < ranks.size(); ++i)
        if (shifted[i] > 0.0) positive += ranks[i];

    const std::vector<double> probabilities = sumProbabilities(ranks);
    const auto place = probabilities.begin() + static_cast<std::ptrdiff_t>(positive);
    const double less = std::accumulate(probabilities.begin(), place + 1, 0.0);
    const double greater = std::accumulate(place, probabilities.end(), 0.0);
    return {
        .greater = std::min(1.0, greater),
        .less = std::min(1.0, less),
        .two_sided = std::min(1.0, 2.0 * std::min(greater, less))};
}

namespace {

// ---- Confidence interval of a median ------------------------------------------------------------

// The number of n independent samples that can be cut off at either end, and the confidence that
// the median then lies inside: 1 - 2 P(Binomial(n, 1/2) < cut).
struct Cut {
    std::size_t count = 0;
    double confidence = 1.0;
};

Cut largestCut(std::size_t n, double alpha) {
    const auto size = static_cast<double>(n);
    Cut cut;
    double log_probability = -size * std::log(2.0);  // of exactly cut.count samples below the
                                                     // median
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
    if (effective < std::min(size, kLeastEffective)) return interval;
    effective = std::clamp(std::floor(effective), 1.0, size);
    const Cut cut = largestCut(static_cast<std::size_t>(effective), alpha);
    // Ranks count from 1. The rank cut.count lies at this share of the way from the middle to the
    // ends.
    const double middle = 0.5 * (size + 1.0);
    const double share =
        (0.5 * (effective + 1.0) - static_cast<double>(cut.count)) / (0.5 * effective);
    const double rank = std::floor(middle - share * 0.5 * size + 1e-9);  // integer up to rounding
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

namespace {

// The sides of the median on which samples lie, as bits.
class Sides {
public:
    Sides(std::span<const double> samples, double median)
        : off_(words(samples.size())), above_(off_.size()) {
        for (std::size_t i = 0; i < samples.size(); ++i) {
            off_[i / kBits] |= std::uint64_t{samples[i] != median} << i % kBits;
            above_[i / kBits] |= std::uint64_t{samples[i] > median} << i % kBits;
        }
    }

    // Returns the sum of the products of sides (-1, 0 or 1) that are `lag` samples apart.
    std::int64_t products(std::size_t lag) const {
        const std::size_t words = lag / kBits;
        const std::size_t bits = lag % kBits;
        const auto later = [&](const std::vector<std::uint64_t>& all, std::size_t i) {
            const std::uint64_t next = bits == 0 ? 0 : all[i + words + 1] << (kBits - bits);
            return all[i + words] >> bits | next;
        };
        std::int64_t sum = 0;
        for (std::size_t i = 0; i + words + 1 < off_.size(); ++i) {
            const std::uint64_t both = off_[i] & later(off_, i);
            sum += std::popcount(both) - 2 * std::popcount(both & (above_[i] ^ later(above_, i)));
        }
        return sum;
    }

private:
    static constexpr std::size_t kBits = 64;
    // One more than there are samples for, so that shifts need no end of their own.
    static std::size_t words(std::size_t samples) { return (samples + kBits - 1) / kBits + 1; }

    std::vector<std::uint64_t> off_;  // not equal to the median
    std::vector<std::uint64_t> above_;
};

}  // namespace

double effectiveSamples(std::span<const double> samples) {
    constexpr double kCaution = 5.0;
    const std::size_t n = samples.size();
    // A median splits evenly, so the mean of the sides is about 0. A series that drifts needs as
    // many sums as it has samples.
    const Sides sides(samples, quantile(samples, 0.5));
    const auto products = [&](std::size_t lag) { return sides.products(lag); };
    const std::int64_t variance = products(0);
    const auto size = static_cast<double>(n);
    if (variance == 0) return size;  // all equal: no dependence
    const auto correlation = [&](std::size_t lag) {
        return static_cast<double>(products(lag)) / static_cast<double>(variance);
    };
    // For a reversible process, sums of two neighbours are positive and decreasing. The sum stops
    // where noise breaks that.
    double time = -1.0;
    double previous = std::numeric_limits<double>::infinity();
    for (std::size_t lag = 0; lag + 1 < n; lag += 2) {
        const double pair = correlation(lag) + correlation(lag + 1);
        if (pair <= 0.0) break;
        previous = std::min(previous, pair);
        time += 2.0 * previous;
    }
    time = std::max(time, 1.0);
    time *= 1.0 + kCaution * std::sqrt((time - 1.0) / size);
    return std::clamp(size / time, 1.0, size);
}

double relativeHalfWidth(const MedianInterval& interval) {
    if (interval.estimate == 0.0) return std::numeric_limits<double>::infinity();
    return 0.5 * (interval.upper - interval.lower) / std::abs(interval.estimate);
}

// ---- False discovery rate -----------------------------------------------------------------------

std::vector<double> falseDiscoveryAdjusted(std::span<const double> p_values) {
    if (!std::ranges::all_of(p_values, [](double p) { return p >= 0.0 && p <= 1.0; }))
        throw engine::Error("false discovery rate", "a p-value is outside [0, 1]");
    std::vector<std::size_t> descending(p_values.size());
    std::iota(descending.begin(), descending.end(), std::size_t{0});
    std::ranges::sort(descending, std::greater<>{}, [&](std::size_t i) { return p_values[i]; });
    std::vector<double> adjusted(p_values.size());
    double smallest = 1.0;
    std::size_t rank = p_values.size();
    for (const std::size_t i : descending) {
        const double ratio = static_cast<double>(p_values.size()) / static_cast<double>(rank--);
        smallest = std::min(smallest, p_values[i] * ratio);
        adjusted[i] = smallest;
    }
    return adjusted;
}

namespace {

// ---- Power laws ---------------------------------------------------------------------------------

// P(|t| <= x) of Student's t, by Abramowitz and Stegun 1964, 26.7.3 and 26.7.4: finite sums that
// are exact for integer degrees of freedom.
double studentWithin(double x, std::size_t degrees) {
    const double n = static_cast<double>(degrees);
    const double angle = std::atan(x / std::sqrt(n));
    const double cosine = std::cos(angle);
    const bool odd = degrees % 2 == 1;
    double term = odd ? cosine : 1.0;
    double total = 0.0;
    // Terms cos^k with the factors (k - 1) / k, from cos (odd) or 1 (even) up to cos^(n - 2).
    for (std::size_t k = odd ? 1 : 0; k + 2 <= degrees; k += 2) {
        total += term;
        term *= cosine * cosine * static_cast<double>(k + 1) / static_cast<double>(k + 2);
    }
    const double sine = std::sin(angle);
    return odd ? 2.0 / std::numbers::pi * (angle + sine * total) : sine * total;
}

}  // namespace

double studentQuantile(double p, std::size_t degrees_of_freedom) {
    if (!(p > 0.0 && p < 1.0) || degrees_of_freedom == 0)
        throw engine::Error("statistics", "no quantile of Student's t");
    const double within = std::abs(2.0 * p - 1.0);
    double low = 0.0;
    double high = 1.0;
    while (studentWithin(high, degrees_of_freedom) < within && high < 1e150) high *= 2.0;
    for (int i = 0; i < 200 && low < high; ++i) {
        const double middle = std::midpoint(low, high);
        (studentWithin(middle, degrees_of_freedom) < within ? low : high) = middle;
    }
    return p < 0.5 ? -high : high;
}

PowerLaw fitPowerLaw(std::span<const double> x, std::span<const double> y, double alpha) {
    if (x.size() != y.size() || x.size() < 2)
        throw engine::Error("statistics", "a power law needs at least two points");
    const auto logarithms = [](std::span<const double> values) {
        std::vector<double> logs;
        for (const double value : values) {
            if (!(value > 0.0) || !std::isfinite(value))
                throw engine::Error("statistics", "a power law needs values above 0");
            logs.push_back(std::log(value));
        }
        return logs;
    };
    const std::vector<double> u = logarithms(x);
    const std::vector<double> v = logarithms(y);
    const double n = static_cast<double>(u.size());
    const double mean_u = sum(u) / n;
    const double mean_v = sum(v) / n;
    double squares = 0.0;
    double products = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i) {
        squares += (u[i] - mean_u) * (u[i] - mean_u);
        products += (u[i] - mean_u) * (v[i] - mean_v);
    }
    if (!(squares > 0.0))
        throw engine::Error("statistics", "a power law needs at least two different places");
    const double exponent = products / squares;
    const double intercept = mean_v - exponent * mean_u;
    PowerLaw law{
        .exponent = exponent,
        .factor = std::exp(intercept),
        .lower = -std::numeric_limits<double>::infinity(),
        .upper = std::numeric_limits<double>::infinity()};
    if (u.size() < 3) return law;
    double residuals = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i) {
        const double residual = v[i] - intercept - exponent * u[i];
        residuals += residual * residual;
    }
    const double error = std::sqrt(residuals / (n - 2.0) / squares);
    const double half = error * studentQuantile(1.0 - 0.5 * alpha, u.size() - 2);
    law.lower = exponent - half;
    law.upper = exponent + half;
    return law;
}

}  // namespace benchmarks::report
