#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/report/report.h"
#include "tests/benchmarks/sample_report.h"

namespace benchmarks {

// Times evenly spread over +-`spread` of 10 ms, in an order without trend: golden-section steps
// (Weyl 1916).
inline std::vector<double> spreadTimes(double spread) {
    std::vector<double> times;
    for (int i = 0; i < 100; ++i) {
        double whole;
        times.push_back(
            10.0 * (1.0 - spread + 2.0 * spread * std::modf(i * 0.6180339887 + 0.5, &whole)));
    }
    return times;
}

// A report on a software device whose single case gives no reason for a doubt.
inline report::Report quietReport() {
    report::Report report = sampleReport();
    report.cases.resize(1);
    report::CaseResult& result = report.cases[0];
    result.metrics[0].samples = spreadTimes(0.01);
    result.conditions = {.steal = 0.0, .other_load = 0.02};
    result.trust = {.pass_sum_over_wall = 0.99, .timestamps = "right"};
    return report;
}

// The JSON of quietReport() after a change.
inline scene::Json judgedReport(const std::function<void(report::Report&)>& change) {
    report::Report report = quietReport();
    if (change) change(report);
    return report::reportJson(report);
}

}  // namespace benchmarks
