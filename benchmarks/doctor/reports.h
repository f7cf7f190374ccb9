#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/doctor/checks.h"
#include "benchmarks/scene/json.h"

namespace benchmarks::report {

// Returns the errors of a document against a JSON Schema (draft-07), by an independent validator.
// Each is a JSON pointer with a description, "/cases/0/status: ...". Both arguments are JSON texts.
std::vector<std::string> schemaErrors(const std::string& schema, const std::string& document);

}  // namespace benchmarks::report

// Decides whether a report may be kept beside others: it must have a valid form, and its times must
// be trusted by the doctor. A report that is kept anyway is marked: its member "untrusted" gives
// the reason.

namespace benchmarks::doctor {

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
