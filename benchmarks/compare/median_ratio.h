#pragma once

#include <span>

#include "benchmarks/decide/verdict.h"

// How two medians of independent samples compare, each known from one process alone.
namespace benchmarks {

struct RatioInterval {
    double lower;  // ln(B/A)
    double upper;
};

// Where ln of the ratio of the medians lies, with confidence 1 - alpha at least: both medians lie
// inside their intervals of confidence 1 - alpha / 2 with that probability (Bonferroni), whatever
// the distributions. Samples are taken to be as dependent as they look. Infinite where either has
// too few, or where a bound is not positive.
RatioInterval
medianRatioInterval(std::span<const double> a, std::span<const double> b, double alpha);

// The comparison before others are taken into account: `p` is the smallest level, in steps of 1 %,
// at which the interval lies outside +-ln(1 + decisive_change), 1 if none does; the verdict is
// inconclusive.
Comparison compareMedians(
    std::span<const double> a, std::span<const double> b, double decisive_change, double alpha);

// Adjusts the p-values of all comparisons as Benjamini and Hochberg do, and passes the verdicts:
// regressed or improved where p is then at most alpha, same where the interval lies inside
// +-ln(1 + tau), inconclusive otherwise.
void passVerdicts(std::span<Comparison> comparisons, double alpha);

}  // namespace benchmarks
