#pragma once

#include <cstddef>
#include <iterator>
#include <span>
#include <vector>

// Order statistics, confidence intervals of medians, signed-rank tests, and their correction for
// multiple testing.
namespace benchmarks::report {

// The signed-rank test: Wilcoxon 1945, Individual comparisons by ranking methods. All results are
// exact. It assumes that the differences are independent and symmetric about one median, and makes
// no other assumption about their distributions.

// More differences than this throw engine::Error: the distribution of the sum has n (n + 1) / 2
// steps.
inline constexpr std::size_t kMostDifferences = 256;

// Returns P(T+ <= t) for t = 0 ... n (n + 1) / 2. T+ is the sum of the ranks of the positive ones
// among n differences without ties or zeros, if either sign is equally likely.
std::vector<double> signedRankDistribution(std::size_t n);

struct MedianInterval {
    double estimate;
    double lower;
    double upper;
    double confidence;  // achieved: at least the requested confidence
};

// Returns the Hodges-Lehmann estimate of the differences' median: the median of all Walsh averages
// (x[i] + x[j]) / 2, i <= j. The interval contains the medians that a two-sided signed-rank test at
// level `alpha` does not reject; Hollander and Wolfe 1999, Nonparametric Statistical Methods, 3.3.
// With too few differences to reject anything (2^(1 - n) > alpha), it is infinite with confidence
// 1. Ties and zeros only make it wider than necessary. Throws engine::Error without a difference,
// or if one is not finite.
MedianInterval signedRankInterval(std::span<const double> differences, double alpha);

// Probabilities of signed ranks at least this extreme if the median is `median`.
struct SignedRankP {
    double greater;  // alternative: the median is greater
    double less;  // alternative: the median is less
    double two_sided;  // twice the smaller of both, at most 1
};

// Leaves out differences equal to the median, like scipy.stats.wilcoxon by default; if none is
// left, all three are 1. Ties share their mean rank, and the distribution is that of the actual
// ranks. This equals scipy's `exact` without ties, and its exhaustive PermutationMethod with ties,
// up to kMostDifferences.
SignedRankP signedRankP(std::span<const double> differences, double median = 0.0);

// Confidence intervals of medians, without an assumption about the distribution.

// Dependent samples that are worth fewer independent ones than this get no interval: their
// dependence is not known well enough. By simulation, 95 % intervals after the stopping rule of
// runs then cover the median of at least 93 % of series, up to a correlation of 0.98 between
// neighbours.
inline constexpr double kLeastEffective = 25.0;

// Returns the sample's median and two order statistics that enclose the distribution's median, for
// independent samples: David and Nagaraja 2003, Order Statistics, 7.1. `effective`, at most the
// number of samples, is the number of independent samples that they count as: the ranks then lie
// further apart, in the same proportion to the whole range. With too few samples for an interval
// (2^(1 - n) > alpha), or dependent ones of fewer than kLeastEffective, it is infinite with
// confidence 1. Throws engine::Error without samples.
MedianInterval medianInterval(std::span<const double> samples, double alpha, double effective);
MedianInterval medianInterval(std::span<const double> samples, double alpha);

// Returns how many independent samples tell as much about the median as these, in the order in
// which they were taken; between 1 and their number. It uses the autocorrelation of the indicator
// of being above the median (Heidelberger and Lewis 1984, Quantile estimation in dependent
// sequences, Operations Research 32), summed by Geyer's initial monotone sequence (1992, Practical
// Markov chain Monte Carlo, Statistical Science 7). The sum tau has a standard error in proportion
// to tau sqrt(tau / n) (Sokal 1997, Monte Carlo methods in statistical mechanics, 3.1). A series
// that ends when its interval is narrow ends sooner where tau came out too small, so tau is raised
// by 5 tau sqrt((tau - 1) / n).
double effectiveSamples(std::span<const double> samples);

// Returns half the interval over the median's magnitude; infinite for a median of 0 or an infinite
// interval.
double relativeHalfWidth(const MedianInterval& interval);

// Returns the p-values as adjusted by Benjamini and Hochberg (1995, Controlling the false discovery
// rate, J. R. Statist. Soc. B 57), in the given order: the smallest false discovery rate at which
// each test is rejected; equals scipy.stats.false_discovery_control. The rate holds for tests that
// are independent or positively dependent (Benjamini and Yekutieli 2001), like passes that slow
// down together. Throws engine::Error for values outside [0, 1].
std::vector<double> falseDiscoveryAdjusted(std::span<const double> p_values);

// A decision may be tried after 12, 24 and 48 pairs, and on large changes after 8. Each try has a
// quarter of the total level (Bonferroni). Whatever the reason to continue, the chance of a false
// decision and the false discovery rate at the last try are then at most the sum. Spending
// functions that leave more for the last try (O'Brien and Fleming 1979) would leave little for the
// first, where most gates should end.
inline constexpr std::size_t kStages[] = {12, 24, 48};
// Equal builds have 8 differences of one sign in 1 of 128 gates, and hardly ever all as large as
// this: a change by this share in every pair is decided. Ranks of 8 pairs can decide nothing else.
inline constexpr std::size_t kEarlyStage = 8;
inline constexpr double kLargeChange = 0.2;

inline constexpr double stageLevel(double whole_level) {
    return whole_level / static_cast<double>(std::size(kStages) + 1);
}

// Growth of a cost: y = factor * x^exponent, by least squares of log y over log x.
struct PowerLaw {
    double exponent;
    double factor;
    // Bounds of the exponent's confidence interval, if the residuals of the logarithms are
    // independent and normal: Student's t, with two degrees of freedom fewer than points. Infinite
    // for two points.
    double lower;
    double upper;
};

// Throws engine::Error unless `x` and `y` have the same size of at least two, all are greater than
// 0, and not all of x are equal. The interval is two-sided at level `alpha`.
PowerLaw fitPowerLaw(std::span<const double> x, std::span<const double> y, double alpha);

// Returns the quantile of Student's t distribution. Throws engine::Error unless `p` is in (0, 1)
// and there is at least one degree of freedom.
double studentQuantile(double p, std::size_t degrees_of_freedom);

// Order statistics of a sample. The functions below need finite values and throw engine::Error
// without any. Results are in the samples' unit unless stated otherwise.
struct Summary {
    std::size_t count;
    double minimum;
    double first_quartile;
    double median;
    double third_quartile;
    double maximum;
    double mean;
    // Median absolute deviation from the median, unscaled: 1.4826 times it is a normal sample's
    // sigma.
    double mad;
    // Sample standard deviation (n - 1) / |mean|, a ratio. 0 for a single value; infinite for a
    // mean of 0 unless all values are equal.
    double relative_deviation;
};

Summary summarize(std::span<const double> samples);

// Returns the quantile by linear interpolation, type 7 of Hyndman and Fan 1996, Sample quantiles in
// statistical packages: at position (n - 1) p of the sorted values, counted from 0. `p` is in [0,
// 1].
double quantile(std::span<const double> samples, double p);

// Returns frames / total time, which is not the mean of the frames' rates.
double framesPerSecond(std::span<const double> frame_ms);

// The three definitions of "the 1 % low" (fraction 0.01), as rates in frames per second.
struct LowRates {
    double percentile;  // of the frame time at quantile 1 - fraction (MangoHud, CapFrameX)
    double mean;  // of the mean of the longest ceil(fraction n) frames (CapFrameX's average)
    double integral;  // of the frame at which the sum of the longest frames reaches that fraction
                      // of the total time
};

LowRates lowRates(std::span<const double> frame_ms, double fraction);

}  // namespace benchmarks::report
