#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/doctor/checks.h"
#include "benchmarks/gate/blocks.h"
#include "benchmarks/report/metric.h"
#include "benchmarks/report/report.h"
#include "benchmarks/scene/json.h"

namespace benchmarks::report {

// Returns the errors of a document against a JSON Schema (draft-07), by an independent validator.
// Each is a JSON pointer with a description, "/cases/0/status: ...". Both arguments are JSON texts.
std::vector<std::string> schemaErrors(const std::string& schema, const std::string& document);

}  // namespace benchmarks::report

// The doctor's own report, and its examination of other reports.
namespace benchmarks::doctor {

// ---- The smallest slowdown that a gate can find -------------------------------------------------

// The smallest slowdown of one metric that a gate can find on this machine.
struct Sensitivity {
    report::MetricId metric;  // of the doctor's scene
    // Tau, as a share: three standard deviations of an A/A pair, at least 2 %.
    double decisive_change = 0.0;
    double smallest_slowdown = 0.0;  // share that 48 pairs find in nine of ten gates
    std::vector<double> differences{};  // ln(A2/A1) of the pairs
};

// Runs pairs of processes of this program against itself, on the doctor's scene. Measures the times
// of the frame and of every pass that is long enough: by wall clock, by CPU time and, where
// available, in instructions. Throws Interrupted.
std::vector<Sensitivity>
measureSensitivity(const engine::DeviceOptions& device, std::uint32_t pairs);

// A gate of this program against itself with a slowdown in one pass.
struct PlantedGate {
    std::string pass;
    double planted = 0.0;  // added share of the pass's cost
    bool found = false;  // the pass regressed
    bool elsewhere = false;  // some other pass regressed too, without added work
};

// Plants 1.5 times the smallest slowdown of the most precise pass, with /run/busy_pass, and gates
// it `gates` times with the calibration of `sensitivities`. Throws Interrupted, and engine::Error
// if no pass can be slowed down.
std::vector<PlantedGate> plantSlowdowns(
    const engine::DeviceOptions& device, const std::vector<Sensitivity>& sensitivities,
    std::uint32_t gates);

// The smallest slowdown of one metric, as a share, that a gate of 48 pairs calls a regression in
// nine of ten gates. Pairs of one build on the machine differ by `differences` = ln(A2/A1), and
// `decisive_change` is tau. None of the gate's other `metrics` is slower, so the slowdown must pass
// the strictest step of Benjamini and Hochberg.
//
// A gate is simulated by drawing 48 of the differences, with replacement and random signs, since
// both signs are equally likely in pairs of one build. A slowdown s shifts all 48 by ln(1 + s). The
// gate finds it if the lower end of their signed-rank interval, at the level of the last decision,
// is above ln(1 + tau) - ln(1 + s). The result is the s for which this holds in 90 % of the draws.
// Throws engine::Error for fewer than two differences. The draws are the same every time.
double
smallestSlowdown(std::span<const double> differences, double decisive_change, std::size_t metrics);

// ---- The doctor's report ------------------------------------------------------------------------

// Report of the doctor: findings, smallest detectable slowdowns, planted slowdowns.

inline constexpr const char* kDoctorSchema = "hairbench-doctor/2.1.0";

struct DoctorReport {
    report::Environment environment;
    std::vector<Finding> findings;
    std::vector<Sensitivity> sensitivities;  // --pairs
    std::vector<PlantedGate> planted;  // --planted
    bool interrupted = false;
};

// The result of the planted slowdowns as a row of the table. It is bad unless each was found, and
// only in its own pass.
Finding judgePlanted(const std::vector<PlantedGate>& gates);

// True if no finding is bad.
bool isTrusted(const DoctorReport& report);

// A table of the findings, the list of remedies, and the detectable slowdowns.
std::string doctorText(const DoctorReport& report);

// Indented JSON, described by results/doctor.schema.json.
std::string doctorReportText(const DoctorReport& report);

// ---- Whether a report may be kept ---------------------------------------------------------------

// Decides whether a report may be kept beside others: it must have a valid form, and its times must
// be trusted by the doctor. A report that is kept anyway is marked: its member "untrusted" gives
// the reason.

struct ReportExamination {
    std::string schema;  // as in the report: "hairbench-report/1.5.0"
    std::string device;  // may be empty
    std::size_t cases = 0;  // 0: this kind of report has none
    std::vector<std::string> schema_errors;  // "/cases/0/status: ..."
    // "5 trusted, 11 doubtful": verdicts on its cases (report/verdict.h); may be empty.
    std::string verdicts{};
    // The worst doubt of each check over all cases that ran, and a build that differs from its
    // commit.
    std::vector<Finding> findings;
    // Figures that were computed again because the report is of an earlier version; may be empty.
    std::string corrections{};
    std::string mark;  // why its times are not to be trusted; empty: it is not marked
};

// Examines a report of any kind. Throws engine::Error if the file is not a report or is damaged.
ReportExamination examineReport(const std::filesystem::path& file);

// True if it conforms to its schema, and nothing is bad or it is marked.
bool isAccepted(const ReportExamination& examination);

// One line: "ok, 16 cases on llvmpipe", or the reason for refusal.
std::string examinationText(const ReportExamination& examination);

// ---- The rules of a good report -----------------------------------------------------------------

// Checks a report against the twelve rules of T. Hoefler and R. Belli, Scientific Benchmarking of
// Parallel Computing Systems (SC 2015, doi 10.1145/2807591.2807644, table 1).

enum class RuleVerdict {
    met,  // by the report
    not_met,  // by the report
    author,  // depends on the text and figures about the report
};

// "met", "not met", "author".
const char* ruleVerdictName(RuleVerdict verdict);

struct RuleFinding {
    std::string rule;  // in a few words
    RuleVerdict verdict = RuleVerdict::met;
    std::string seen;  // what in the report meets it, is missing, or must be added by the author
};

// One finding for each rule, in order. `report` is from report::readReport(). Throws engine::Error
// if it is damaged.
std::vector<RuleFinding> judgeRules(const scene::Json& report);

// True if no rule is violated.
bool meetsRules(const std::vector<RuleFinding>& findings);

// A numbered table and the number of rules met.
std::string rulesText(const std::vector<RuleFinding>& findings);

}  // namespace benchmarks::doctor
