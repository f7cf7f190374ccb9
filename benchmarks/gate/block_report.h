#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/compare/judged_metrics.h"
#include "benchmarks/compare/mismatch.h"
#include "benchmarks/json_text.h"

namespace benchmarks {

struct BlockCase {
    CaseOutcome outcome;
    std::vector<MetricReading> metrics;  // none where it did not run
};

// What a gate takes from the report of one process.
struct BlockReport {
    Document environment;
    Document scene;  // path and hash
    bool software_device = false;
    std::vector<BlockCase> cases;
};

// Throws engine::Error where there is no report, or none of this kind.
BlockReport readBlock(const std::filesystem::path& report);

const BlockCase* findCase(const BlockReport& block, const std::string& name);

// A metric of a case that both blocks have; they have to outlive it.
struct CommonMetric {
    std::string case_name;
    const MetricReading* a;
    const MetricReading* b;
};

// In A's order.
std::vector<CommonMetric> commonMetrics(const BlockReport& a, const BlockReport& b);

// What differs in any case that both have.
std::vector<Mismatch> mismatches(const BlockReport& a, const BlockReport& b);

}  // namespace benchmarks
