#include "benchmarks/ablate/ablation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "benchmarks/report/statistics.h"
#include "benchmarks/report/text.h"

namespace benchmarks::ablate {

std::optional<std::uint64_t>
measuredCount(std::span<const StopRecord> stops, Stop stop, std::string_view name) {
    for (const StopRecord& record : stops) {
        if (record.times.stop != stop) continue;
        const auto found = std::ranges::find(record.statistics, name, &report::Statistic::name);
        if (found != record.statistics.end()) return found->measured;
    }
    return std::nullopt;
}

namespace {

// ---- JSON ---------------------------------------------------------------------------------------

void putText(scene::Json& object, const char* key, const std::string& text) {
    if (!text.empty()) object[key] = text;
}

scene::Json toJson(const Cost& cost) {
    scene::Json object = scene::Json::object();
    object["estimate"] = cost.estimate;
    if (cost.interval)
        object["interval"] = {
            {"lower", cost.interval->lower},
            {"upper", cost.interval->upper},
            {"confidence", cost.interval->confidence}};
    return object;
}

scene::Json timeJson(const StopTimes& stop) {
    scene::Json object = scene::Json::object();
    object["unit"] = "ms";
    std::vector<double> times;
    scene::Json laps = scene::Json::array();
    for (const Lap& lap : stop.laps) {
        times.push_back(lapTime(lap));
        laps.push_back({{"up", lap.up}, {"down", lap.down}});
    }
    const report::Summary summary = report::summarize(times);
    object["median"] = summary.median;
    object["mad"] = summary.mad;
    object["laps"] = std::move(laps);
    return object;
}

scene::Json toJson(const StopRecord& stop) {
    scene::Json object = {
        {"name", stopName(stop.times.stop)},
        {"tessellation", stop.tessellation},
        {"samples", stop.samples}};
    if (!stop.times.laps.empty()) object["time"] = timeJson(stop.times);
    scene::Json statistics = scene::Json::object();
    for (const report::Statistic& each : stop.statistics) {
        scene::Json line = scene::Json::object();
        line["measured"] = each.measured;
        if (each.expected) line["expected"] = *each.expected;
        putText(line, "note", each.note);
        statistics[each.name] = std::move(line);
    }
    object["statistics"] = std::move(statistics);
    return object;
}

void putCost(scene::Json& object, const RungCost& rung, const std::vector<UnitCost>& units) {
    object["marginal"] = toJson(rung.marginal);
    object["share"] = rung.share;
    scene::Json per = scene::Json::object();
    for (const UnitCost& unit : units) {
        if (unit.rung != rung.stop) continue;
        scene::Json cost = {{"unit", "ns"}, {"value", unit.nanoseconds}, {"count", unit.count}};
        putText(cost, "note", unit.note);
        per[unit.unit] = std::move(cost);
    }
    object["per"] = std::move(per);
}

scene::Json toJson(const Residual& residual) {
    scene::Json object = {
        {"closure", toJson(residual.closure)}, {"discard", toJson(residual.discard)}};
    if (residual.multisampling) object["multisampling"] = toJson(*residual.multisampling);
    object["interaction"] = toJson(residual.interaction);
    return object;
}

void putMeasured(scene::Json& object, const CaseAblation& result) {
    object["frame"] = result.frame;
    putText(object, "timing", result.timing);
    scene::Json counts = scene::Json::object();
    for (const auto& [name, count] : result.counts) counts[name] = count;
    object["counts"] = std::move(counts);
    putText(object, "image_hash", result.image_hash);
    scene::Json rungs = scene::Json::array();
    scene::Json checks = scene::Json::array();
    for (const StopRecord& stop : result.stops)
        (isRung(stop.times.stop) ? rungs : checks).push_back(toJson(stop));
    if (result.attribution) {
        const Attribution& attribution = *result.attribution;
        for (std::size_t i = 0; i < attribution.rungs.size(); ++i)
            putCost(rungs[i], attribution.rungs[i], result.unit_costs);
        object["residual"] = toJson(attribution.residual);
        scene::Json watching = scene::Json::object();
        for (const auto& [stop, cost] : attribution.watching)
            watching[stopName(stop)] = toJson(cost);
        object["watching"] = std::move(watching);
    }
    object["rungs"] = std::move(rungs);
    object["checks"] = std::move(checks);
    object["warnings"] = result.warnings;
}

scene::Json toJson(const CaseAblation& result) {
    scene::Json object = {{"name", result.name}, {"axes", scene::Json::object()}};
    for (const scene::AxisValue& axis : result.axes)
        object["axes"][axis.pointer] = axis.value.json();
    object["status"] = report::statusName(result.status);
    putText(object, "reason", result.reason);
    if (result.status == report::Status::ok) putMeasured(object, result);
    return object;
}

}  // namespace

std::string ablationText(const AblationReport& report) {
    scene::Json object = {
        {"schema", kAblationSchema}, {"environment", report::environmentJson(report.environment)}};
    object["scene"] = {
        {"path", report.scene.path},
        {"hash", report.scene.hash},
        {"document", report.scene.document.json()}};
    object["notes"] = report.notes;
    object["laps"] = report.laps;
    object["interrupted"] = report.interrupted;
    scene::Json cases = scene::Json::array();
    for (const CaseAblation& each : report.cases) cases.push_back(toJson(each));
    object["cases"] = std::move(cases);
    // Output of drivers and commands need not be UTF-8.
    return object.dump(2, ' ', false, scene::Json::error_handler_t::replace) + '\n';
}

namespace {

// ---- Table for a terminal -----------------------------------------------------------------------

std::string rungTitle(const StopRecord& stop) {
    switch (stop.times.stop) {
    case Stop::tessellation_1:
    case Stop::tessellation:
        return "tessellation " + std::to_string(stop.tessellation);
    case Stop::msaa:
        return "msaa " + std::to_string(stop.samples);
    default:
        return stopName(stop.times.stop);
    }
}

std::string intervalCell(const Cost& cost) {
    if (!cost.interval) return "-";
    return report::shortNumber(cost.interval->lower) + " .. " +
           report::shortNumber(cost.interval->upper);
}

std::string percentCell(double share) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.1f", 100.0 * share);
    return text.data();
}

const UnitCost* findUnit(const CaseAblation& ablation, Stop rung, const std::string& unit) {
    for (const UnitCost& each : ablation.unit_costs)
        if (each.rung == rung && each.unit == unit) return &each;
    return nullptr;
}

std::string unitCell(const UnitCost* cost) {
    return cost ? report::shortNumber(cost->nanoseconds) : "-";
}

// Cost per item of the stage's own kind of work.
std::string ownUnitCell(const CaseAblation& ablation, Stop rung) {
    for (const UnitCost& each : ablation.unit_costs) {
        if (each.rung != rung || each.unit == "strand" || each.unit == "segment") continue;
        return report::shortNumber(each.nanoseconds) + " / " + each.unit +
               (each.note.empty() ? "" : " (" + each.note + ')');
    }
    return {};
}

std::vector<report::Column> columns(const CaseAblation& ablation) {
    std::vector<report::Column> all{{"rung", false},   {"time, ms"}, {"marginal, ms"},
                                    {"95 % interval"}, {"share, %"}, {"ns / strand"},
                                    {"ns / segment"},  {"ns", false}};
    for (std::size_t i = 0; i < ablation.attribution->rungs.size(); ++i) {
        const RungCost& rung = ablation.attribution->rungs[i];
        const std::array cells{
            rungTitle(ablation.stops[i]),
            report::shortNumber(rung.time),
            report::shortNumber(rung.marginal.estimate),
            intervalCell(rung.marginal),
            percentCell(rung.share),
            unitCell(findUnit(ablation, rung.stop, "strand")),
            unitCell(findUnit(ablation, rung.stop, "segment")),
            ownUnitCell(ablation, rung.stop)};
        for (std::size_t c = 0; c < all.size(); ++c) all[c].cells.push_back(cells[c]);
    }
    return all;
}

std::string costLine(const char* what, const Cost& cost) {
    std::string line = std::string(what) + ": " + report::shortNumber(cost.estimate) + " ms";
    if (cost.interval) line += " (" + intervalCell(cost) + ')';
    return line + '\n';
}

std::string rest(const Attribution& attribution) {
    std::string text =
        "the unchanged pass: " + report::shortNumber(attribution.pass_time) + " ms\n";
    const Residual& residual = attribution.residual;
    text += costLine("  minus all marginal costs", residual.closure);
    text += "all primitives clipped instead of discarded: " +
            report::shortNumber(attribution.clipped_time) + " ms\n";
    text += costLine("  minus the geometry rung", residual.discard);
    if (residual.multisampling)
        text += costLine(
            "cost of samples with a fragment shader, minus their cost without one",
            *residual.multisampling);
    text += costLine("interaction residual, the sum of these", residual.interaction);
    for (const auto& [stop, cost] : attribution.watching) text += costLine(stopName(stop), cost);
    return text;
}

}  // namespace

std::string ablationTable(const CaseAblation& ablation) {
    std::string text = ablation.name + '\n';
    if (ablation.status != report::Status::ok)
        return text + report::statusName(ablation.status) + ": " + ablation.reason + '\n';
    if (ablation.attribution) {
        const std::vector<report::Column> all = columns(ablation);
        for (std::size_t row = 0; row <= ablation.attribution->rungs.size(); ++row)
            text += report::columnsLine(all, row);
        text += rest(*ablation.attribution);
    }
    for (const std::string& warning : ablation.warnings) text += "warning: " + warning + '\n';
    return text;
}

}  // namespace benchmarks::ablate
