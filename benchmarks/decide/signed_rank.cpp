#include "benchmarks/decide/signed_rank.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "benchmarks/statistics.h"
#include "engine/error.h"

namespace benchmarks {
namespace {

// P(sum = s) of the ranks with a positive sign, each sign as likely as the other. Every step is a
// mean of two earlier probabilities, so that nothing cancels.
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

// Mean ranks of sorted magnitudes, as multiples of the largest number that makes them whole: 1
// without ties, often 1/2 with them.
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
    // So many Walsh averages may be cut off at either end.
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

}  // namespace benchmarks
