#include "benchmarks/gate/report.h"

#include <cmath>
#include <algorithm>
#include <iterator>
#include <set>

#include <nlohmann/json.hpp>

#include "benchmarks/report/compare.h"
#include "benchmarks/report/statistics.h"
#include "benchmarks/report/text.h"

namespace benchmarks::gate {
namespace {

// ---- JSON ---------------------------------------------------------------------------------------

const char* phaseName(Phase phase) {
    switch (phase) {
    case Phase::warm_up:
        return "warm_up";
    case Phase::calibration:
        return "calibration";
    case Phase::gate:
        return "gate";
    }
    return "gate";
}

const char* endName(GateRun::End end) {
    switch (end) {
    case GateRun::End::decided:
        return "decided";
    case GateRun::End::interrupted:
        return "interrupted";
    case GateRun::End::out_of_time:
        return "out_of_time";
    case GateRun::End::failed:
        return "failed";
    }
    return "failed";
}

// Numbers that are not finite become null in lists, because omitting them would shift the others.
scene::Json numbers(const std::vector<double>& values) {
    scene::Json list = scene::Json::array();
    for (const double value : values)
        list.push_back(std::isfinite(value) ? scene::Json(value) : scene::Json());
    return list;
}

scene::Json outcomesJson(const BlockReport& block) {
    scene::Json list = scene::Json::array();
    for (const BlockCase& each : block.cases) {
        const report::CaseOutcome& outcome = each.outcome;
        scene::Json object = {{"name", outcome.name}, {"status", outcome.status}};
        if (!outcome.reason.empty()) object["reason"] = outcome.reason;
        if (!outcome.image_hash.empty()) object["image_hash"] = outcome.image_hash;
        if (!outcome.state_hash.empty()) object["state_hash"] = outcome.state_hash;
        list.push_back(std::move(object));
    }
    return list;
}

scene::Json
sideJson(const GateRun& run, const Side& side, const std::optional<BlockReport>& first) {
    scene::Json object = {{"given", side.text}};
    object["command"] = blockCommand(side, run.scene, "{out}", 0);
    if (first) {
        object["environment"] = first->environment.json();
        object["scene"] = first->scene.json();
        object["cases"] = outcomesJson(*first);
    }
    return object;
}

scene::Json timesJson(const GateRun& run) {
    const std::vector<std::vector<double>> differences = pairDifferences(run, Phase::gate);
    scene::Json list = scene::Json::array();
    for (std::size_t i = 0; i < run.times.size(); ++i) {
        const GateTime& time = run.times[i];
        scene::Json object = {
            {"case", time.case_name},
            {"metric", time.metric.name()},
            {"unit", time.metric.unit},
            {"hint", report::betterName(time.metric.better)}};
        if (time.metric.mode != report::Mode::none)
            object["mode"] = report::modeName(time.metric.mode);
        if (time.share) object["share"] = *time.share;
        if (!time.decides) object["decides"] = false;
        if (!time.calibration.empty()) object["calibration"] = time.calibration;
        object["differences"] = numbers(differences[i]);
        list.push_back(std::move(object));
    }
    return list;
}

scene::Json blocksJson(const GateRun& run) {
    scene::Json list = scene::Json::array();
    for (const BlockRecord& each : run.blocks) {
        list.push_back(
            {{"phase", phaseName(each.phase)},
             {"side", std::string{each.side}},
             {"pair", each.pair},
             {"order_seed", each.seed},
             {"medians", numbers(each.medians)}});
        if (std::ranges::count(each.capped, 0) < std::ssize(each.capped))
            list.back()["capped"] = std::vector<bool>(each.capped.begin(), each.capped.end());
    }
    return list;
}

}  // namespace

scene::Json gateReport(
    const GateRun& run, const report::VerdictOptions& options,
    const std::vector<std::string>& command) {
    scene::Json object = {{"schema", kGateSchema}, {"command", command}, {"scene", run.scene}};
    object["end"] = endName(run.end);
    if (!run.failure.empty()) object["failure"] = run.failure;
    const bool known = run.end == GateRun::End::decided || run.decided_at > 0;
    object["verdict"] =
        report::verdictName(known ? overallVerdict(run) : report::Verdict::inconclusive);
    if (run.decided_at > 0) object["decided_at"] = run.decided_at;
    object["exit_status"] = exitStatus(run, options);
    object["a"] = sideJson(run, run.a, run.first_a);
    object["b"] = sideJson(run, run.b, run.first_b);
    object["rule"] = {
        {"threshold", run.rule.threshold},
        {"alpha", run.rule.alpha},
        {"smallest_share", options.smallest_share},
        {"decisions", scene::Json::array()}};
    if (run.rule.first_pairs == *std::begin(report::kStages)) {
        object["rule"]["large_change"] = report::kLargeChange;
        object["rule"]["decisions"].push_back(report::kEarlyStage);
    }
    for (const std::size_t stage : report::kStages)
        if (stage >= run.rule.first_pairs) object["rule"]["decisions"].push_back(stage);
    object["pairs"] = run.pairs;
    if (run.repeated_blocks > 0) object["repeated_blocks"] = run.repeated_blocks;
    object["unmatched"] = run.unmatched;
    object["times"] = timesJson(run);
    scene::Json& too_short = object["too_short"] = scene::Json::array();
    for (const GateTime& each : run.too_short)
        too_short.push_back({{"case", each.case_name}, {"metric", each.metric.name()}});
    object["blocks"] = blocksJson(run);
    scene::Json& differing = object["mismatches"] = scene::Json::array();
    for (const report::Mismatch& each : run.mismatches)
        differing.push_back(report::mismatchJson(each));
    if (run.unstable != 0) object["unstable_side"] = std::string{run.unstable};
    scene::Json& changes = object["changes"] = scene::Json::array();
    for (const report::Change& each : run.changes) changes.push_back(report::changeJson(each));
    return object;
}

namespace {

// ---- Text for a terminal ------------------------------------------------------------------------

// "build/old, hairbench 0.1.0 (1a2b3c4)"
std::string sideText(const Side& side, const std::optional<BlockReport>& first) {
    std::string text = std::string{side.name} + ": " + side.text;
    if (!first) return text + '\n';
    const scene::Json& environment = first->environment.json();
    if (const auto build = environment.find("build"); build != environment.end()) {
        text += ", hairbench " + build->value("version", "");
        if (const std::string commit = build->value("commit", ""); !commit.empty())
            text += " (" + commit + ')';
    }
    return text + '\n';
}

// Omits what two builds on one machine share. From the scenes, only cases and results count.
std::string differencesText(const GateRun& run) {
    if (!run.first_a || !run.first_b) return {};
    std::string text;
    const scene::Json a = {{"environment", run.first_a->environment.json()}};
    const scene::Json b = {{"environment", run.first_b->environment.json()}};
    for (const std::string& each : report::environmentDifferences(a, b))
        text += "warning: " + each + '\n';
    return text;
}

std::string mismatchesText(const GateRun& run) {
    if (run.mismatches.empty()) return {};
    std::string text;
    if (run.unstable != 0)
        text += std::string("The runs of ") + run.unstable + " differ among themselves.\n";
    for (const report::Mismatch& each : run.mismatches) text += report::mismatchText(each) + '\n';
    return text + "mismatch: times of different work can't be compared\n";
}

report::ShowCases showCases(const GateRun& run) {
    std::set<std::string> names;
    for (const GateTime& each : run.times) names.insert(each.case_name);
    return names.size() > 1 ? report::ShowCases::yes : report::ShowCases::no;
}

std::string tooShortText(const GateRun& run) {
    if (run.too_short.empty()) return {};
    const bool software = run.first_a->software_device && run.first_b->software_device;
    std::string text =
        "shorter than " +
        report::plainNumber(software ? report::kShortestTime : report::kShortestTimestamped) +
        " ms, not judged:";
    std::set<std::string> names;
    for (const GateTime& each : run.too_short) names.insert(each.metric.name());
    for (const std::string& name : names) text += ' ' + name;
    return text + '\n';
}

std::string incomparableText(const GateRun& run) {
    std::string text;
    for (const report::Change& each : run.changes)
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
    text += report::changesTable(run.changes, showCases(run)) + tooShortText(run) +
            incomparableText(run) + '\n';
    if (run.end != GateRun::End::decided)
        text += run.decided_at > 0 ? "stopped; the verdicts are those passed at " +
                                         std::to_string(run.decided_at) + " pairs\n"
                                   : std::string("stopped before the first verdict\n");
    return text + report::verdictCounts(run.changes) + '\n';
}

}  // namespace benchmarks::gate
