#pragma once

#include <cstddef>
#include <span>
#include <vector>

// Wilcoxon 1945, Individual comparisons by ranking methods; exact throughout. It takes differences
// to be independent and each distributed symmetrically about one median; nothing about the shape.
namespace benchmarks {

// More differences than this are an engine::Error: the distribution of the sum has n (n + 1) / 2
// steps.
inline constexpr std::size_t kMostDifferences = 256;

// P(T+ <= t) for t = 0 ... n (n + 1) / 2: T+ is the sum of the ranks of the positive differences,
// of n without ties or zeros, when either sign is equally likely.
std::vector<double> signedRankDistribution(std::size_t n);

struct MedianInterval {
    double estimate;
    double lower;
    double upper;
    double confidence;  // achieved: at least what was asked for
};

// The Hodges-Lehmann estimate of the differences' median, which is the median of all Walsh averages
// (x[i] + x[j]) / 2, i <= j, with the interval of those medians that a two-sided signed-rank test
// at level `alpha` does not reject; Hollander and Wolfe 1999, Nonparametric Statistical Methods,
// 3.3. Where so few differences can reject nothing (2^(1 - n) > alpha) it is infinite, with
// confidence 1. Ties and zeros only make it wider than it has to be. At least one difference,
// all finite, or engine::Error.
MedianInterval signedRankInterval(std::span<const double> differences, double alpha);

// How likely signed ranks at least this extreme are if the median is `median`.
struct SignedRankP {
    double greater;  // alternative: the median is greater
    double less;  // alternative: it is less
    double two_sided;  // twice the smaller one, at most 1
};

// Differences equal to the median are left out, as scipy.stats.wilcoxon does by default; if none is
// left, all three are 1. Ties share their mean rank, and the distribution is that of the ranks at
// hand: scipy's `exact` without ties, its exhaustive PermutationMethod with them, but up to
// kMostDifferences.
SignedRankP signedRankP(std::span<const double> differences, double median = 0.0);

}  // namespace benchmarks
