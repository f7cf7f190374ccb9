#include <cmath>
#include <set>

#include <nlohmann/json.hpp>

#include "benchmarks/compare/environment_differences.h"
#include "benchmarks/gate/gate_report.h"

namespace benchmarks {

namespace {

// "build/old, hairbench 0.1.0 (1a2b3c4)"
std::string sideText(const Side& side, const std::optional<BlockReport>& first) {
    std::string text = std::string{side.name} + ": " + side.text;
    if (!first) return text + '\n';
    const Json& environment = first->environment.json();
    if (const auto build = environment.find("build"); build != environment.end()) {
        text += ", hairbench " + build->value("version", "");
        if (const std::string commit = build->value("commit", ""); !commit.empty())
            text += " (" + commit + ')';
    }
    return text + '\n';
}

// What two builds on one machine share is left out: of the scenes only cases and results count.
std::string differencesText(const GateRun& run) {
    if (!run.first_a || !run.first_b) return {};
    std::string text;
    const Json a = {{"environment", run.first_a->environment.json()}};
    const Json b = {{"environment", run.first_b->environment.json()}};
    for (const std::string& each : environmentDifferences(a, b)) text += "warning: " + each + '\n';
    return text;
}

std::string mismatchesText(const GateRun& run) {
    if (run.mismatches.empty()) return {};
    std::string text;
    if (run.unstable != 0)
        text += std::string("The runs of ") + run.unstable + " differ among themselves.\n";
    for (const Mismatch& each : run.mismatches) text += mismatchText(each) + '\n';
    return text + "mismatch: times of different work say nothing\n";
}

ShowCases showCases(const GateRun& run) {
    std::set<std::string> names;
    for (const GateTime& each : run.times) names.insert(each.case_name);
    return names.size() > 1 ? ShowCases::yes : ShowCases::no;
}

std::string tooShortText(const GateRun& run) {
    if (run.too_short.empty()) return {};
    std::string text = "shorter than 0.05 ms, not judged:";
    std::set<std::string> names;
    for (const GateTime& each : run.too_short) names.insert(each.metric.name());
    for (const std::string& name : names) text += ' ' + name;
    return text + '\n';
}

std::string incomparableText(const GateRun& run) {
    std::string text;
    for (const Change& each : run.changes)
        if (!std::isfinite(each.comparison.change)) text += ' ' + each.metric.name();
    return text.empty() ? text : "missing, or timed in another way, in some process:" + text + '\n';
}

std::string calibrationText(const GateRun& run) {
    if (run.times.empty() || run.times.front().calibration.empty()) return {};
    return " after " + std::to_string(run.times.front().calibration.size()) + " of A with itself";
}

}  // namespace

std::string gateText(const GateRun& run) {
    std::string text = sideText(run.a, run.first_a) + sideText(run.b, run.first_b);
    text += differencesText(run);
    for (const std::string& each : run.unmatched) text += each + '\n';
    if (!run.mismatches.empty()) return text + mismatchesText(run);
    if (run.changes.empty()) return text;
    text += run.scene + ", " + std::to_string(run.pairs) + (run.pairs == 1 ? " pair" : " pairs") +
            calibrationText(run) + "\n\n";
    text += changesTable(run.changes, showCases(run)) + tooShortText(run) + incomparableText(run) +
            '\n';
    return text + verdictCounts(run.changes) + '\n';
}

}  // namespace benchmarks
