#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "benchmarks/decide/verdict.h"
#include "benchmarks/json_fwd.h"
#include "benchmarks/metric.h"

namespace benchmarks {

// What a comparison says of one metric of one case.
struct Change {
    std::string case_name;
    MetricId metric;
    std::string unit;
    double a = 0.0;  // medians, in the unit
    double b = 0.0;
    // Of the cost: of times as they are, of rates of 1 / rate. Positive is worse.
    Comparison comparison;
};

// {"case", "metric", "unit", "a", "b", "change", "lower", "upper", "decisive_change", "p",
// "verdict"}; bounds that are not known are absent.
Json changeJson(const Change& change);

enum class ShowCases { yes, no };

// A row for each: case, metric, A, B, the change with its interval and tau in percent, verdict.
// Empty where there are none.
std::string changesTable(std::span<const Change> changes, ShowCases show_cases);

// "1 regressed, 0 improved, 7 same, 2 inconclusive"
std::string verdictCounts(std::span<const Change> changes);

std::size_t countOf(std::span<const Change> changes, Verdict verdict);

// "regressed" if any is; then "inconclusive", if any is, then "improved", then "same".
Verdict overallVerdict(std::span<const Change> changes);

// The exit status that goes with it.
int verdictStatus(Verdict verdict, bool fail_on_inconclusive);

// "+1.8 %"
std::string percentText(double share);

}  // namespace benchmarks
