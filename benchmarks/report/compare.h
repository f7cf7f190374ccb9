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

// Why times of two reports may differ though the code does not: "device: X and Y", one line for
// each of device, driver, processor, the build's type, the scene, validation, and a report that was
// interrupted. A member that either report lacks is not known to differ.
std::vector<std::string> environmentDifferences(const scene::Json& a, const scene::Json& b);

// Whether the report's device is the processor itself, where CPU time is what passes cost.
bool isSoftwareDevice(const scene::Json& environment);

// Where a time is shorter in both builds it is not judged: 2 % of it are 1 us, which is the step of
// coarse timestamps and less than it takes to wake a thread.
inline constexpr double kShortestTime = 0.05;  // ms

// The same of a device that is no processor: its timestamps are finer, and what disturbs a
// processor's work does not lie between them.
inline constexpr double kShortestStamped = 0.002;  // ms

enum class Judgement { judged, too_short, not_wanted };

// What times are of.
enum class Clock {
    wall,
    processor,  // what all threads used: on a software device what a pass costs, whoever else is at
                // work on the machine; it does not see that threads wait for each other
};

// What is judged unless --metrics says otherwise: the processor's time on a software device whose
// reports have it. `metrics` are those that both reports have.
Clock judgedClock(bool software_device, std::span<const MetricId> metrics);

// Which metrics count.
using MetricChoice = std::function<bool(const MetricId&)>;

// The metrics in whose name a regex is found; an empty function for an empty one. Throws
// engine::Error
// "--metrics: ..." for a malformed one.
MetricChoice metricsNamed(const std::string& regex);

// The times of frames and passes by the wall clock, or their CPU time and their instructions.
MetricChoice timesBy(Clock clock);

// Judges a metric that two reports have. A metric of which neither less nor more is better is not
// judged, nor a time below `shortest`, ms.
Judgement judgementOf(
    const MetricChoice& chosen, const MetricReading& a, const MetricReading& b, double shortest);

// Larger is worse: a value in the metric's unit, or 1 / value where higher is better.
double costOf(const Metric& metric, double value);

// What a case made, as its report says.
struct CaseOutcome {
    std::string name;
    std::string status;  // "ok", "skipped", "failed"
    std::string reason;  // why it was not ok
    std::string image_hash;  // may be empty: not known
    std::string state_hash;
};

// Something of a case that differs between two reports, so that their times say nothing.
struct Mismatch {
    std::string case_name;
    std::string what;  // "picture", "state", or "status" where only one played it
    std::string a;  // hashes, or "failed: reason"
    std::string b;
};

// Reads the outcome from a case's object in a report.
CaseOutcome caseOutcome(const scene::Json& result);

// Hashes that either report does not know agree. Of a case that neither played nothing differs.
std::vector<Mismatch> mismatches(const CaseOutcome& a, const CaseOutcome& b);

// "thesis/msaa:4: the pictures differ: 0123456789abcdef and fedcba9876543210"
std::string mismatchText(const Mismatch& mismatch);

// {"case", "what", "a", "b"}
scene::Json mismatchJson(const Mismatch& mismatch);

// Two reports of one process each, held against each other.

struct CompareOptions {
    std::filesystem::path a;  // empty where `baseline` is given
    std::filesystem::path b;
    std::string baseline;
    VerdictOptions verdict;
    bool all = false;  // rows of what stayed the same too
    bool json = false;
};

struct ReportComparison {
    std::vector<std::string> warnings;  // why the two may not be comparable
    bool same_device = true;  // name and type
    std::size_t common_cases = 0;  // that both have, by name
    // "only in A: thesis/msaa:4"; of cases that both have, "only in A: pass.wind.time, of 2 cases"
    std::vector<std::string> unmatched;
    std::vector<Mismatch> mismatches;
    std::vector<Change> changes;  // of cases without a mismatch
    std::vector<Change> too_short;  // not judged: see kShortestTime
};

// Verdicts over all metrics of all cases that both played, at level 5 %. It knows nothing of the
// noise between processes. Throws engine::Error for a report that lacks what reports must have, or
// a malformed regex.
ReportComparison
compareReports(const scene::Json& a, const scene::Json& b, const VerdictOptions& options);

// `mismatch` if there is one, otherwise as overallVerdict().
Verdict overallVerdict(const ReportComparison& comparison);

// "hairbench-comparison/1.0.0": all of it, and the names of the two.
scene::Json
comparisonJson(const ReportComparison& comparison, const std::string& a, const std::string& b);

inline constexpr const char* kOneProcessCaveat =
    "One process each: noise between processes (8 to 15 % on software devices) is not known here. "
    "hairbench gate decides.";

}  // namespace benchmarks::report
