#pragma once

#include <cstddef>
#include <iterator>
#include <span>
#include <vector>

// Order statistics, confidence intervals of medians, signed-rank tests and their correction for
// multiple testing.
namespace benchmarks::report {

// The signed-rank test: Wilcoxon 1945, Individual comparisons by ranking methods; exact throughout.
// It takes differences to be independent and each distributed symmetrically about one median;
// nothing about the shape.

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

// How well a median is known, without assuming a distribution.

// The sample's median and two of its order statistics between which the distribution's median lies,
// for independent samples: David and Nagaraja 2003, Order Statistics, 7.1. `samples` may count as
// `effective` independent ones, fewer than they are: the ranks then lie further apart, in the same
// proportion to what is between the ends. An infinite interval with confidence 1 where so few can
// give none (2^(1 - n) > alpha). No sample is an engine::Error.
MedianInterval medianInterval(std::span<const double> samples, double alpha, double effective);
MedianInterval medianInterval(std::span<const double> samples, double alpha);

// How many independent samples tell as much of the median as these, in the order in which they were
// taken; between 1 and their number. What counts for a median is how being above it is correlated
// from sample to sample (Heidelberger and Lewis 1984, Quantile estimation in dependent sequences,
// Operations Research 32); these correlations are added up as Geyer's initial monotone sequence
// does (1992, Practical Markov chain Monte Carlo, Statistical Science 7).
double effectiveSamples(std::span<const double> samples);

// Half the interval over the median's magnitude; infinite for a median of 0 or no interval.
double relativeHalfWidth(const MedianInterval& interval);

// Each p-value as Benjamini and Hochberg adjust it (1995, Controlling the false discovery rate, J.
// R. Statist. Soc. B 57): the smallest rate of false discoveries at which its test is among the
// rejected, in the order given; scipy.stats.false_discovery_control. The rate holds for tests that
// are independent or positively dependent (Benjamini and Yekutieli 2001), as passes are that slow
// down together. Values outside [0, 1] are an engine::Error.
std::vector<double> falseDiscoveryAdjusted(std::span<const double> p_values);

// A decision may be tried after 12 pairs, after 24 and after 48. Each try has a third of the whole
// level (Bonferroni): whatever makes one go on, the chance of any false decision, and the rate of
// false discoveries at whichever try it ends, is at most the sum. Spending functions that leave
// more for the last try (O'Brien and Fleming 1979) would have little left for the first, at which
// most gates should end.
inline constexpr std::size_t kStages[] = {12, 24, 48};

inline constexpr double stageLevel(double whole_level) {
    return whole_level / static_cast<double>(std::size(kStages));
}

// How a cost grows: y = factor * x^exponent, by least squares of log y over log x.
struct PowerLaw {
    double exponent;
    double factor;
    // Between which the exponent lies with the confidence that was asked for, if the logarithms'
    // residuals are independent and normal: Student's t with two fewer degrees of freedom than
    // points. Infinite of two points.
    double lower;
    double upper;
};

// `x` and `y` are as many, at least two, all greater than 0, and not all of x are equal, or
// engine::Error. Two-sided at level `alpha`.
PowerLaw fitPowerLaw(std::span<const double> x, std::span<const double> y, double alpha);

// The quantile of Student's t distribution, `p` in (0, 1), or engine::Error.
double studentQuantile(double p, std::size_t degrees_of_freedom);

// Order statistics of a sample. Everything here wants at least one value, all finite: none at all
// is an engine::Error. Results are in the samples' unit unless said otherwise.
struct Summary {
    std::size_t count;
    double minimum;
    double first_quartile;
    double median;
    double third_quartile;
    double maximum;
    double mean;
    // Median absolute deviation from the median, raw: multiply by 1.4826 for a normal sample's
    // sigma.
    double mad;
    // Sample standard deviation (n - 1) / |mean|, a ratio; 0 for a single value, infinite for a
    // mean of 0 with any spread.
    double relative_deviation;
};

Summary summarize(std::span<const double> samples);

// Quantile by linear interpolation, type 7 of Hyndman and Fan 1996, Sample quantiles in statistical
// packages: at position (n - 1) p of the sorted values, counted from 0. `p` is in [0, 1].
double quantile(std::span<const double> samples, double p);

// Frames per second: frames / total time, which is not the mean of the frames' rates.
double framesPerSecond(std::span<const double> frame_ms);

// The three things that are called "the 1 % low" (fraction 0.01), as rates in frames per second.
struct LowRates {
    double percentile;  // of the frame time at quantile 1 - fraction (MangoHud, CapFrameX)
    double mean;  // of the mean of the longest ceil(fraction n) frames (CapFrameX's average)
    double integral;  // of the frame at which the longest frames, summed, reach the fraction of all
                      // the time
};

LowRates lowRates(std::span<const double> frame_ms, double fraction);

}  // namespace benchmarks::report
