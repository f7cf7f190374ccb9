#include "benchmarks/gate/gate_report.h"

#include <cmath>
#include <iterator>

#include <nlohmann/json.hpp>

#include "benchmarks/decide/multiple_tests.h"

namespace benchmarks {

namespace {

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
    case GateRun::End::failed:
        return "failed";
    }
    return "failed";
}

// What is not a number is null in lists, where leaving it out would move the others.
Json numbers(const std::vector<double>& values) {
    Json list = Json::array();
    for (const double value : values) list.push_back(std::isfinite(value) ? Json(value) : Json());
    return list;
}

Json outcomesJson(const BlockReport& block) {
    Json list = Json::array();
    for (const BlockCase& each : block.cases) {
        const CaseOutcome& outcome = each.outcome;
        Json object = {{"name", outcome.name}, {"status", outcome.status}};
        if (!outcome.reason.empty()) object["reason"] = outcome.reason;
        if (!outcome.image_hash.empty()) object["image_hash"] = outcome.image_hash;
        if (!outcome.state_hash.empty()) object["state_hash"] = outcome.state_hash;
        list.push_back(std::move(object));
    }
    return list;
}

Json sideJson(const GateRun& run, const Side& side, const std::optional<BlockReport>& first) {
    Json object = {{"given", side.text}};
    object["command"] = blockCommand(side, run.scene, "{out}", 0);
    if (first) {
        object["environment"] = first->environment.json();
        object["scene"] = first->scene.json();
        object["cases"] = outcomesJson(*first);
    }
    return object;
}

Json timesJson(const GateRun& run) {
    const std::vector<std::vector<double>> differences = pairDifferences(run, Phase::gate);
    Json list = Json::array();
    for (std::size_t i = 0; i < run.times.size(); ++i) {
        const GateTime& time = run.times[i];
        Json object = {
            {"case", time.case_name},
            {"metric", time.metric.name()},
            {"unit", time.metric.unit},
            {"hint", betterName(time.metric.better)}};
        if (time.metric.mode != Mode::none) object["mode"] = modeName(time.metric.mode);
        if (!time.calibration.empty()) object["calibration"] = time.calibration;
        object["differences"] = numbers(differences[i]);
        list.push_back(std::move(object));
    }
    return list;
}

Json blocksJson(const GateRun& run) {
    Json list = Json::array();
    for (const BlockRecord& each : run.blocks)
        list.push_back(
            {{"phase", phaseName(each.phase)},
             {"side", std::string{each.side}},
             {"pair", each.pair},
             {"order_seed", each.seed},
             {"medians", numbers(each.medians)}});
    return list;
}

}  // namespace

Json gateReport(
    const GateRun& run, const VerdictOptions& options, const std::vector<std::string>& command) {
    Json object = {{"schema", kGateSchema}, {"command", command}, {"scene", run.scene}};
    object["end"] = endName(run.end);
    if (!run.failure.empty()) object["failure"] = run.failure;
    object["verdict"] = run.end == GateRun::End::decided ? Json(verdictName(overallVerdict(run)))
                                                         : Json("inconclusive");
    object["exit_status"] = exitStatus(run, options);
    object["a"] = sideJson(run, run.a, run.first_a);
    object["b"] = sideJson(run, run.b, run.first_b);
    object["rule"] = {
        {"threshold", run.rule.threshold}, {"alpha", run.rule.alpha}, {"decisions", Json::array()}};
    for (const std::size_t stage : kStages)
        if (stage >= run.rule.first_pairs) object["rule"]["decisions"].push_back(stage);
    object["pairs"] = run.pairs;
    object["unmatched"] = run.unmatched;
    object["times"] = timesJson(run);
    Json& too_short = object["too_short"] = Json::array();
    for (const GateTime& each : run.too_short)
        too_short.push_back({{"case", each.case_name}, {"metric", each.metric.name()}});
    object["blocks"] = blocksJson(run);
    Json& differing = object["mismatches"] = Json::array();
    for (const Mismatch& each : run.mismatches) differing.push_back(mismatchJson(each));
    if (run.unstable != 0) object["unstable_side"] = std::string{run.unstable};
    Json& changes = object["changes"] = Json::array();
    for (const Change& each : run.changes) changes.push_back(changeJson(each));
    return object;
}

}  // namespace benchmarks
