#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/report/metric.h"
#include "benchmarks/report/statistics.h"
#include "benchmarks/scene/json.h"

// Whether B is slower than A: verdicts on metrics, and the exit statuses that they give.
namespace benchmarks::report {

// When a comparison fails.
struct VerdictOptions {
    double threshold = 0.02;  // a change of this share matters to nobody
    bool fail_on_inconclusive = false;
    std::string metrics;  // regex of the metrics that count; empty: all times
    // A pass that is less of its frame than this is shown and decides nothing (gate).
    double smallest_share = 0.02;
};

enum class Verdict { regressed, improved, same, inconclusive, mismatch };

const char* verdictName(Verdict verdict);

struct VerdictRule {
    double threshold = 0.02;  // a change of this share matters to nobody
    double alpha = 0.05;      // over all tries and metrics: see statistics.h
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
    std::size_t pairs = 0;  // that the verdict was passed at; 0: none was
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

// What a comparison says of one metric of one case.
struct Change {
    std::string case_name;
    MetricId metric;
    std::string unit;
    double a = 0.0;  // medians, in the unit
    double b = 0.0;
    // Compares the cost: a time as it is, a rate by 1 / rate. A positive change is worse.
    Comparison comparison;
    bool decides = true;  // whether the whole verdict depends on it
    bool by_clock = false;  // the time changed and its cycles did not: the device's clock did
};

// {"case", "metric", "unit", "a", "b", "change", "lower", "upper", "decisive_change", "p",
// "verdict"}; bounds that are not known are absent.
scene::Json changeJson(const Change& change);

enum class ShowCases { yes, no };

// A row for each: case, metric, A, B, the change with its interval and tau in percent, verdict.
// Empty where there are none.
std::string changesTable(std::span<const Change> changes, ShowCases show_cases);

// "1 regressed, 0 improved, 7 same, 2 inconclusive", of those that decide.
std::string verdictCounts(std::span<const Change> changes);

// "regressed" if any that decides is; then "inconclusive", if any is, then "improved", then "same".
Verdict overallVerdict(std::span<const Change> changes);

// The exit status that goes with it.
int verdictStatus(Verdict verdict, bool fail_on_inconclusive);

// How two medians of independent samples compare, each known from one process alone, before other
// metrics are taken into account. With confidence 1 - alpha at least the true change lies between
// `lower` and `upper`: both medians lie inside their intervals of confidence 1 - alpha / 2 with
// that probability (Bonferroni), whatever the distributions. The bounds are -1 and infinity where
// either has too few samples, or where a bound of a median is not positive. `p` is the smallest
// level, in steps of 1 %, at which the interval of ln(B/A) lies outside +-ln(1 + decisive_change),
// 1 if none does; the verdict is inconclusive. Samples are taken to be as dependent as they look.
Comparison compareMedians(
    std::span<const double> a, std::span<const double> b, double decisive_change, double alpha);

// Adjusts the p-values of all comparisons as Benjamini and Hochberg do, and passes the verdicts:
// regressed or improved where p is then at most alpha, same where the interval lies inside
// +-ln(1 + tau), inconclusive otherwise.
void passVerdicts(std::span<Comparison> comparisons, double alpha);

// What the program's exit status means. Verdicts keep off 1 and 2: make turns every failure into 2.
inline constexpr int kOk = 0;
inline constexpr int kInternalError = 1;
inline constexpr int kUsageError = 2;  // of the command line, or an invalid scene
inline constexpr int kCheckFailed = 3;  // a gated check of the physics or of doctor did not pass
inline constexpr int kRegressed = 10;  // something became slower
inline constexpr int kInconclusive = 11;  // nothing is known to be slower, but not all is known;
                                          // where --fail-on inconclusive asks for it
inline constexpr int kMismatch = 12;  // pictures or states differ
inline constexpr int kNoBaseline = 13;  // the baseline is missing or of something else
inline constexpr int kNothingRan = 14;  // every case was skipped, failed or filtered out
inline constexpr int kNoDevice = 77;  // no suitable Vulkan device
inline constexpr int kInterrupted = 130;  // Ctrl-C; what was done is saved

}  // namespace benchmarks::report
