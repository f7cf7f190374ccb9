#include "benchmarks/lod_report.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <nlohmann/json.hpp>

namespace benchmarks {

namespace {

Json toJson(const LodTimes& times) { return {{"strands", times.strands}, {"frame", times.frame}}; }

Json toJson(const LodStep& step) {
    Json object = {{"distance", step.distance}, {"mean_level", step.mean_level}};
    if (step.strands) object["strands"] = *step.strands;
    object["full_strands"] = step.full_strands;
    object["error"] = step.error;
    if (step.popping) object["popping"] = *step.popping;
    object["coverage"] = step.coverage;
    object["full_coverage"] = step.full_coverage;
    object["time"] = toJson(step.time);
    object["full_time"] = toJson(step.full_time);
    return object;
}

Json toJson(const LodTotals& totals) {
    Json object = Json::object();
    if (totals.worst_popping) object["worst_popping"] = *totals.worst_popping;
    object["mean_coverage_change"] = totals.mean_coverage_change;
    object["worst_coverage_change"] = totals.worst_coverage_change;
    object["strands_speed_up"] = totals.strands_speed_up;
    object["frame_speed_up"] = totals.frame_speed_up;
    return object;
}

}  // namespace

LodTotals totalsOf(const std::vector<LodStep>& steps) {
    assert(!steps.empty());
    LodTotals totals;
    LodTimes time;
    LodTimes full;
    for (const LodStep& step : steps) {
        if (step.popping)
            totals.worst_popping = std::max(totals.worst_popping.value_or(0.0), *step.popping);
        const double change =
            step.full_coverage > 0.0 ? step.coverage / step.full_coverage - 1.0 : 0.0;
        totals.mean_coverage_change += change / static_cast<double>(steps.size());
        if (std::abs(change) > std::abs(totals.worst_coverage_change))
            totals.worst_coverage_change = change;
        time.strands += step.time.strands;
        time.frame += step.time.frame;
        full.strands += step.full_time.strands;
        full.frame += step.full_time.frame;
    }
    totals.strands_speed_up = full.strands / time.strands;
    totals.frame_speed_up = full.frame / time.frame;
    return totals;
}

std::string lodReportText(const LodReport& report) {
    Json object = Json::object();
    object["schema"] = kLodSchema;
    object["environment"] = environmentJson(report.environment);
    object["scene"] = {
        {"path", report.scene.path},
        {"hash", report.scene.hash},
        {"document", report.scene.document.json()}};
    object["frame"] = report.frame;
    object["interrupted"] = report.interrupted;
    Json& steps = object["steps"] = Json::array();
    for (const LodStep& step : report.steps) steps.push_back(toJson(step));
    if (!report.steps.empty()) object["totals"] = toJson(totalsOf(report.steps));
    // What drivers and commands say need not be UTF-8.
    return object.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace benchmarks
