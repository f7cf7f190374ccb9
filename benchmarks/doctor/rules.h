#pragma once

#include <string>
#include <vector>

#include "benchmarks/scene/json.h"

// Holds a report against the twelve rules of T. Hoefler and R. Belli, Scientific Benchmarking of
// Parallel Computing Systems (SC 2015, doi 10.1145/2807591.2807644, table 1).
namespace benchmarks::doctor {

enum class RuleVerdict {
    met,      // by the report
    not_met,  // by the report
    author,   // a matter of what is written and drawn about it
};

// "met", "not met", "author".
const char* ruleVerdictName(RuleVerdict verdict);

struct RuleFinding {
    std::string rule;  // in a few words
    RuleVerdict verdict = RuleVerdict::met;
    std::string seen;  // what of the report meets it, lacks, or has to be said beside it
};

// One finding for each rule, in their order. `report` is as report::readReport() gives it. Throws
// engine::Error for one that is damaged.
std::vector<RuleFinding> judgeRules(const scene::Json& report);

// Whether none is not met.
bool meetsRules(const std::vector<RuleFinding>& findings);

// A numbered table, and how many rules are met.
std::string rulesText(const std::vector<RuleFinding>& findings);

}  // namespace benchmarks::doctor
