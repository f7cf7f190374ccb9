#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/report/change.h"
#include "benchmarks/report/metric.h"
#include "benchmarks/scene/json.h"

// Comparison of two reports, each of one process.

namespace benchmarks::report {

// Returns the reasons why times of two reports may differ although the code does not: one line
// "device: X and Y" for each difference in device, driver, processor, build type, scene,
// validation, and one for a report that was interrupted. A member that either report lacks does not
// count as a difference.
std::vector<std::string> environmentDifferences(const scene::Json& a, const scene::Json& b);

// Times below this in both builds are not judged. 2 % of it is 1 us: one step of coarse timestamps,
// and less than a thread takes to wake.
inline constexpr double kShortestTime = 0.05;  // ms

// The same limit for a GPU: its timestamps are finer, and interruptions of the host do not fall
// between them.
inline constexpr double kShortestTimestamped = 0.002;  // ms

enum class Judgement { judged, too_short, not_wanted };

// The clock that a time is measured by.
enum class Clock {
    wall,
    processor,  // CPU time of all threads. On a software device this is the cost of a pass even
                // when other programs run, but it leaves out the time that threads wait for each
                // other.
};

// Returns the clock whose times are judged unless --metrics says otherwise: CPU time on a software
// device if the reports have it. `metrics` are those in both reports.
Clock judgedClock(bool software_device, std::span<const MetricId> metrics);

// Decides whether a metric counts.
using MetricChoice = std::function<bool(const MetricId&)>;

// Returns a choice of the metrics with a match of the regex in their name, or an empty function for
// an empty regex. Throws engine::Error "--metrics: ..." for a malformed one.
MetricChoice metricsNamed(const std::string& regex);

// Returns the choice without --metrics: times of frames and passes by judgedClock(), or their CPU
// times and instructions. If both reports have no time of a frame or pass, returns a choice of the
// figures of compiled shaders, which otherwise only explain times. `metrics` as for judgedClock().
MetricChoice usualMetrics(bool software_device, std::span<const MetricId> metrics);

// Decides whether to judge a metric that both reports have. Metrics without a better direction are
// not judged, nor are times below `shortest`, ms.
Judgement judgementOf(
    const MetricChoice& chosen, const MetricReading& a, const MetricReading& b, double shortest);

// Returns a value for which larger is worse: `value` itself, or 1 / value where higher is better.
double costOf(const Metric& metric, double value);

// The outcome of a case in its report.
struct CaseOutcome {
    std::string name;
    std::string status;  // "ok", "skipped", "failed"
    std::string reason;  // why it was not ok
    std::string image_hash;  // empty if unknown
    std::string state_hash;
};

// A difference between two reports' results of a case. It makes their times incomparable.
struct Mismatch {
    std::string case_name;
    // "picture", "state", "status" where only one of them ran, or "probe" that only one of them has
    std::string what;
    std::string a;  // hashes, "failed: reason", or the probe's name and "none"
    std::string b;
};

// Reads the outcome from a case object of a report.
CaseOutcome caseOutcome(const scene::Json& result);

// An unknown hash matches any other. Returns nothing for a case that ran in neither report.
std::vector<Mismatch> mismatches(const CaseOutcome& a, const CaseOutcome& b);

// "thesis/msaa:4: the pictures differ: 0123456789abcdef and fedcba9876543210"
std::string mismatchText(const Mismatch& mismatch);

// {"case", "what", "a", "b"}
scene::Json mismatchJson(const Mismatch& mismatch);

// A figure of a compiled shader that differs and isn't judged. It may explain a change of times.
struct CodeChange {
    MetricId metric;
    std::string unit;
    double a = 0.0;
    double b = 0.0;
    std::size_t cases = 1;  // with these values
};

// Adds the change of a metric of a case if it is a figure of a compiled shader and differs.
void addCodeChange(
    const MetricReading& a, const MetricReading& b, std::vector<CodeChange>& changes);

// A table under a title, with a row for each change; empty without changes.
std::string codeChangesText(std::span<const CodeChange> changes);

// [{"metric", "unit", "a", "b", "cases"}]
scene::Json codeChangesJson(std::span<const CodeChange> changes);

// Comparison of two reports, each of one process.

struct CompareOptions {
    std::filesystem::path a;  // empty where `baseline` is given
    std::filesystem::path b;
    std::string baseline;
    VerdictOptions verdict;
    bool all = false;  // also show rows without a change
    bool json = false;
    std::filesystem::path out = {};  // file for the same JSON; empty: none
};

struct ReportComparison {
    std::vector<std::string> warnings;  // why the two may not be comparable
    bool same_device = true;  // compares name and type
    std::size_t common_cases = 0;  // cases in both reports, by name
    // "only in A: thesis/msaa:4"; for metrics of common cases "only in A: pass.wind.time, of 2
    // cases"
    std::vector<std::string> unmatched;
    std::vector<Mismatch> mismatches;
    std::vector<Change> changes;  // of cases without a mismatch
    std::vector<Change> too_short;  // not judged: see kShortestTime
    std::vector<CodeChange> code;  // of cases without a mismatch
};

// Gives verdicts on all metrics of all cases that ran in both reports, at level 5 %. Does not
// account for noise between processes. Throws engine::Error for a malformed regex or a report that
// lacks a required member.
ReportComparison
compareReports(const scene::Json& a, const scene::Json& b, const VerdictOptions& options);

// Returns `mismatch` if there is a mismatch, otherwise the overall verdict of the changes.
Verdict overallVerdict(const ReportComparison& comparison);

// Returns the whole comparison, with the names of both reports, as "hairbench-comparison/1.1.0".
scene::Json
comparisonJson(const ReportComparison& comparison, const std::string& a, const std::string& b);

inline constexpr const char* kOneProcessCaveat =
    "One process each: noise between processes (8 to 15 % on software devices) is not known here. "
    "hairbench gate decides.";

// Reports that are kept under a name, for comparison with later ones.

// Returns the path of the report that is kept under that name for that scene: NAME/SCENE.json in
// $HAIRBENCH_BASELINES or results/local/baselines. Throws engine::Error for a name that is not a
// plain file name.
std::filesystem::path baselineFile(const std::string& name, const std::string& scene);

// Keeps a copy of a written report, with all its samples, under that name and its scene's name.
// Does not copy the pictures.
void saveBaseline(const std::string& name, const std::filesystem::path& report);

// Returns the scene's name, under which the report is kept: "thesis" for "scenes/thesis.json".
// Throws engine::Error for a report without a scene.
std::string sceneNameOf(const scene::Json& report);

}  // namespace benchmarks::report
