#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/report/metric.h"
#include "benchmarks/report/statistics.h"
#include "benchmarks/scene/json.h"

// Decides whether B is slower than A: verdicts on metrics, and the exit statuses that they give.
namespace benchmarks::report {

// Options that decide when a comparison fails.
struct VerdictOptions {
    double threshold = 0.02;  // smaller changes, as a share, do not count
    bool fail_on_inconclusive = false;
    bool pass_without_verdicts = false;  // a gate that is out of time before the first ones passes
    std::string metrics;  // regex of the metrics that count; empty: all times
    // Only probes count. States and pictures may then differ.
    bool probes = false;
    // A pass with a smaller share of its frame than this is shown but decides nothing (gate).
    double smallest_share = 0.02;
};

enum class Verdict { regressed, improved, same, inconclusive, mismatch };

const char* verdictName(Verdict verdict);

struct VerdictRule {
    double threshold = 0.02;  // smaller changes, as a share, do not count
    double alpha = 0.05;  // over all tries and metrics: see statistics.h
    std::size_t first_pairs = 12;  // first try: one of kStages; a later one leaves each try's level
                                   // unchanged and the total below alpha
};

// Returns tau, the smallest change of one metric that counts, as a share:
// max(threshold, 3 * 1.4826 * MAD of ln(A2/A1) over the pairs of an A/A calibration). For normal
// pairs, the second term is three standard deviations. Without a calibration, returns the
// threshold.
double decisiveChange(double threshold, std::span<const double> calibration);

// The result of comparing one metric over all pairs.
struct Comparison {
    Verdict verdict;
    double change;  // median of B/A - 1, a share; NaN if unknown
    double lower;  // interval at the try's level, shares; infinite with too few pairs
    double upper;
    double decisive_change;  // tau: smaller changes do not count
    double p;  // for the median lying outside +-tau, adjusted over all metrics
    std::size_t pairs = 0;  // at which the gate decided; otherwise 0
};

// Gives verdicts on several metrics at once. Each has one difference ln(B/A) per pair and its own
// tau. With b = ln(1 + tau) and a = alpha / 4, the level of each try:
//   regressed, improved   the median of the differences lies above b, below -b: two-sided exact
//                         signed-rank tests at level a, adjusted by Benjamini and Hochberg. For a
//                         single metric, its interval with confidence 1 - a then lies there
//   same                  the interval lies inside (-b, b)
//   inconclusive          otherwise
// Larger is worse for every metric. The result depends only on the arguments, so a verdict can be
// recomputed from a report.
std::vector<Comparison> compare(
    std::span<const std::vector<double>> differences, std::span<const double> decisive_changes,
    double alpha);

// The change of one metric of one case.
struct Change {
    std::string case_name;
    MetricId metric;
    std::string unit;
    double a = 0.0;  // medians, in the unit; of a probe, values where they differ most
    double b = 0.0;
    // Compares the cost: a time itself, or 1 / rate for a rate. A positive change is worse.
    Comparison comparison;
    bool decides = true;  // whether the overall verdict depends on it
    bool by_clock = false;  // the time changed but its cycles did not: the device's clock changed
};

// {"case", "metric", "unit", "a", "b", "change", "lower", "upper", "decisive_change", "p",
// "verdict"}. Unknown bounds are left out.
scene::Json changeJson(const Change& change);

enum class ShowCases { yes, no };

// Returns a table with a row for each change: case, metric, A, B, the change with its interval and
// tau in percent, verdict. Empty without changes.
std::string changesTable(std::span<const Change> changes, ShowCases show_cases);

// "1 regressed, 0 improved, 7 same, 2 inconclusive". Counts only the changes that decide.
std::string verdictCounts(std::span<const Change> changes);

// Returns "regressed" if any change that decides is, otherwise "mismatch" if hair moves otherwise,
// otherwise "inconclusive" if any is, otherwise "improved" if any is, otherwise "same".
Verdict overallVerdict(std::span<const Change> changes);

// Returns the exit status for a verdict.
int verdictStatus(Verdict verdict, bool fail_on_inconclusive);

// Compares two medians of independent samples, each from a single process, before the correction
// for other metrics. The true change lies between `lower` and `upper` with confidence of at least
// 1 - alpha: with that probability, both medians lie inside their intervals of confidence
// 1 - alpha / 2 (Bonferroni), whatever the distributions. The bounds are -1 and infinity where
// either side has too few samples or a bound of a median is not positive. `p` is the smallest
// level, in steps of 1 %, at which the interval of ln(B/A) lies outside +-ln(1 + decisive_change),
// or 1 if there is none. The verdict is inconclusive. The dependence between samples is estimated
// from the samples.
Comparison compareMedians(
    std::span<const double> a, std::span<const double> b, double decisive_change, double alpha);

// Adjusts the p-values of all comparisons by Benjamini and Hochberg, and sets the verdicts:
// regressed or improved where the adjusted p is at most alpha, same where the interval lies inside
// +-ln(1 + tau), inconclusive otherwise.
void passVerdicts(std::span<Comparison> comparisons, double alpha);

// Exit statuses of the program. Verdicts avoid 1 and 2, because make turns every failure into 2.
inline constexpr int kOk = 0;
inline constexpr int kInternalError = 1;
inline constexpr int kUsageError = 2;  // wrong command line, or an invalid scene
inline constexpr int kCheckFailed = 3;  // a gated check of physics or doctor did not pass
inline constexpr int kRegressed = 10;  // something became slower
inline constexpr int kInconclusive = 11;  // nothing is known to be slower, but some changes are
                                          // undecided; only with --fail-on inconclusive. Also a
                                          // gate out of time before the first verdicts
inline constexpr int kMismatch = 12;  // pictures or states differ
inline constexpr int kNoBaseline = 13;  // the baseline is missing, of another device, or has
                                        // nothing in common
inline constexpr int kNothingRan = 14;  // every case was skipped, failed or filtered out
inline constexpr int kNotTrusted = 15;  // times are not to be trusted; only with --fail-on doubtful
                                        // or untrusted
inline constexpr int kNoDevice = 77;  // no suitable Vulkan device
inline constexpr int kInterrupted = 130;  // Ctrl-C; finished cases are saved

}  // namespace benchmarks::report
