#include "benchmarks/ablate/ablation_text.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "benchmarks/statistics.h"

namespace benchmarks {

namespace {

void putText(Json& object, const char* key, const std::string& text) {
    if (!text.empty()) object[key] = text;
}

Json toJson(const Cost& cost) {
    Json object = Json::object();
    object["estimate"] = cost.estimate;
    if (cost.interval)
        object["interval"] = {
            {"lower", cost.interval->lower},
            {"upper", cost.interval->upper},
            {"confidence", cost.interval->confidence}};
    return object;
}

Json timeJson(const StopTimes& stop) {
    Json object = Json::object();
    object["unit"] = "ms";
    std::vector<double> times;
    Json laps = Json::array();
    for (const Lap& lap : stop.laps) {
        times.push_back(lapTime(lap));
        laps.push_back({{"up", lap.up}, {"down", lap.down}});
    }
    const Summary summary = summarize(times);
    object["median"] = summary.median;
    object["mad"] = summary.mad;
    object["laps"] = std::move(laps);
    return object;
}

Json toJson(const StopRecord& stop) {
    Json object = {
        {"name", stopName(stop.times.stop)},
        {"tessellation", stop.tessellation},
        {"samples", stop.samples}};
    if (!stop.times.laps.empty()) object["time"] = timeJson(stop.times);
    Json statistics = Json::object();
    for (const Statistic& each : stop.statistics) {
        Json line = Json::object();
        line["measured"] = each.measured;
        if (each.expected) line["expected"] = *each.expected;
        putText(line, "note", each.note);
        statistics[each.name] = std::move(line);
    }
    object["statistics"] = std::move(statistics);
    return object;
}

void putCost(Json& object, const RungCost& rung, const std::vector<UnitCost>& units) {
    object["marginal"] = toJson(rung.marginal);
    object["share"] = rung.share;
    Json per = Json::object();
    for (const UnitCost& unit : units) {
        if (unit.rung != rung.stop) continue;
        Json cost = {{"unit", "ns"}, {"value", unit.nanoseconds}, {"count", unit.count}};
        putText(cost, "note", unit.note);
        per[unit.unit] = std::move(cost);
    }
    object["per"] = std::move(per);
}

Json toJson(const Residual& residual) {
    Json object = {{"closure", toJson(residual.closure)}, {"discard", toJson(residual.discard)}};
    if (residual.multisampling) object["multisampling"] = toJson(*residual.multisampling);
    object["interaction"] = toJson(residual.interaction);
    return object;
}

void putMeasured(Json& object, const CaseAblation& result) {
    object["frame"] = result.frame;
    putText(object, "timing", result.timing);
    Json counts = Json::object();
    for (const auto& [name, count] : result.counts) counts[name] = count;
    object["counts"] = std::move(counts);
    putText(object, "image_hash", result.image_hash);
    Json rungs = Json::array();
    Json checks = Json::array();
    for (const StopRecord& stop : result.stops)
        (isRung(stop.times.stop) ? rungs : checks).push_back(toJson(stop));
    if (result.attribution) {
        const Attribution& attribution = *result.attribution;
        for (std::size_t i = 0; i < attribution.rungs.size(); ++i)
            putCost(rungs[i], attribution.rungs[i], result.unit_costs);
        object["residual"] = toJson(attribution.residual);
        Json watching = Json::object();
        for (const auto& [stop, cost] : attribution.watching)
            watching[stopName(stop)] = toJson(cost);
        object["watching"] = std::move(watching);
    }
    object["rungs"] = std::move(rungs);
    object["checks"] = std::move(checks);
    object["warnings"] = result.warnings;
}

Json toJson(const CaseAblation& result) {
    Json object = {{"name", result.name}, {"axes", Json::object()}};
    for (const AxisValue& axis : result.axes) object["axes"][axis.pointer] = axis.value.json();
    object["status"] = statusName(result.status);
    putText(object, "reason", result.reason);
    if (result.status == Status::ok) putMeasured(object, result);
    return object;
}

}  // namespace

std::string ablationText(const AblationReport& report) {
    Json object = {
        {"schema", kAblationSchema}, {"environment", environmentJson(report.environment)}};
    object["scene"] = {
        {"path", report.scene.path},
        {"hash", report.scene.hash},
        {"document", report.scene.document.json()}};
    object["notes"] = report.notes;
    object["laps"] = report.laps;
    object["interrupted"] = report.interrupted;
    Json cases = Json::array();
    for (const CaseAblation& each : report.cases) cases.push_back(toJson(each));
    object["cases"] = std::move(cases);
    // What drivers and commands say need not be UTF-8.
    return object.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace benchmarks
