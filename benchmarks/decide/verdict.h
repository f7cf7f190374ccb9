#pragma once

#include <string>
#include <cstddef>
#include <span>
#include <vector>

#include "benchmarks/decide/signed_rank.h"

// Whether B is slower than A, from pairs of process blocks.
namespace benchmarks {

// When a comparison fails.
struct VerdictOptions {
    double threshold = 0.02;  // a change of this share matters to nobody
    bool fail_on_inconclusive = false;
    std::string metrics;  // regex of the metrics that count; empty: all times
};

enum class Verdict { regressed, improved, same, inconclusive, mismatch };

const char* verdictName(Verdict verdict);

struct VerdictRule {
    double threshold = 0.02;  // a change of this share matters to nobody
    double alpha = 0.05;      // over all tries and metrics: see multiple_tests.h
    std::size_t first_pairs = 12;  // of the first try: one of kStages; a later one leaves each
                                   // try's level as it is, and the whole below alpha
};

// What changes of one metric count: max(threshold, 3 * 1.4826 * MAD of ln(A2/A1) over the pairs of
// an A/A calibration), a share; three standard deviations of a pair if they are normal. The
// threshold if there was no calibration.
double decisiveChange(double threshold, std::span<const double> calibration);

// What the pairs say of one metric.
struct Comparison {
    Verdict verdict;
    double change;  // median of B/A - 1, a share; NaN if nothing is known
    double lower;  // its interval at the try's level, shares; infinite if too few pairs
    double upper;
    double decisive_change;  // tau: below it, changes count as none
    double p;  // that the median lies outside +-tau, adjusted over all metrics
};

// Verdicts on several metrics at once, each of which has one difference ln(B/A) a pair and its own
// tau. With b = ln(1 + tau) and a = alpha / 3, the level of each try:
//   regressed, improved   the median of the differences lies above b, below -b: two-sided exact
//                         signed-rank tests at level a after Benjamini and Hochberg. For a single
//                         metric this is to say that its interval with confidence 1 - a lies there
//   same                  the interval lies inside (-b, b)
//   inconclusive          otherwise
// Larger is worse, for every metric. A function of its arguments only, so that a verdict can be
// worked out again from a report.
std::vector<Comparison> compare(
    std::span<const std::vector<double>> differences, std::span<const double> decisive_changes,
    double alpha);

}  // namespace benchmarks
