#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/decide/verdict.h"
#include "benchmarks/compare/change.h"
#include "benchmarks/compare/mismatch.h"
#include "benchmarks/json_fwd.h"

// Two reports of one process each, held against each other.
namespace benchmarks {

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
    std::vector<std::string> unmatched;  // "only in A: thesis/msaa:4"
    std::vector<Mismatch> mismatches;
    std::vector<Change> changes;  // of cases without a mismatch
    std::vector<Change> too_short;  // not judged: see kShortestTime
};

// Verdicts over all metrics of all cases that both played, at level 5 %. It knows nothing of the
// noise between processes. Throws engine::Error for a report that lacks what reports must have, or
// a malformed regex.
ReportComparison compareReports(const Json& a, const Json& b, const VerdictOptions& options);

// `mismatch` if there is one, otherwise as overallVerdict().
Verdict overallVerdict(const ReportComparison& comparison);

// "hairbench-comparison/1.0.0": all of it, and the names of the two.
Json comparisonJson(const ReportComparison& comparison, const std::string& a, const std::string& b);

inline constexpr const char* kOneProcessCaveat =
    "One process each: noise between processes (8 to 15 % on software devices) is not known here. "
    "hairbench gate decides.";

}  // namespace benchmarks
