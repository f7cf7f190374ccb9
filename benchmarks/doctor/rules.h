#pragma once

#include <string>
#include <vector>

#include "benchmarks/scene/json.h"

// Checks a report against the twelve rules of T. Hoefler and R. Belli, Scientific Benchmarking of
// Parallel Computing Systems (SC 2015, doi 10.1145/2807591.2807644, table 1).
namespace benchmarks::doctor {

enum class RuleVerdict {
    met,      // by the report
    not_met,  // by the report
    author,   // depends on the text and figures about the report
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
