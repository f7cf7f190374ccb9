#include "benchmarks/ablate/ablation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "benchmarks/report/statistics.h"
#include "benchmarks/report/text.h"

namespace benchmarks::ablate {
namespace {

// ---- Marginal costs and residuals ---------------------------------------------------------------

constexpr double kAlpha = 0.05;

// A stop's times with a factor.
struct Term {
    Stop stop;
    double factor;
};

Cost sumOf(std::span<const StopTimes> stops, std::span<const Term> terms) {
    std::vector<double> sums(stops.front().laps.size(), 0.0);
    for (const Term& term : terms) {
        const std::vector<double> times = lapTimes(stops, term.stop);
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += term.factor * times[i];
    }
    return costOf(sums);
}

Cost difference(std::span<const StopTimes> stops, Stop with, Stop without) {
    return sumOf(stops, std::array{Term{with, 1.0}, Term{without, -1.0}});
}

Residual residualOf(std::span<const StopTimes> stops) {
    const bool multisampled = hasStop(stops, Stop::msaa);
    const Stop top = multisampled ? Stop::msaa : Stop::fragment;
    Residual residual{
        .closure = difference(stops, Stop::pass, top),
        .discard = difference(stops, Stop::clipped, Stop::geometry)};
    const std::array samples{
        Term{Stop::msaa, 1.0}, Term{Stop::fragment, -1.0}, Term{Stop::raster_msaa, -1.0},
        Term{Stop::raster, 1.0}};
    std::vector<Term> all{
        {Stop::pass, 1.0}, {top, -1.0}, {Stop::clipped, 1.0}, {Stop::geometry, -1.0}};
    if (multisampled) {
        residual.multisampling = sumOf(stops, samples);
        all.insert(all.end(), samples.begin(), samples.end());
    }
    residual.interaction = sumOf(stops, all);
    return residual;
}

}  // namespace

Cost costOf(std::span<const double> differences) {
    const report::MedianInterval interval = report::signedRankInterval(differences, kAlpha);
    Cost cost{.estimate = interval.estimate};
    if (std::isfinite(interval.lower) && std::isfinite(interval.upper))
        cost.interval = {interval.lower, interval.upper, interval.confidence};
    return cost;
}

Attribution attribute(std::span<const StopTimes> stops) {
    Attribution attribution{
        .pass_time = report::summarize(lapTimes(stops, Stop::pass)).median,
        .clipped_time = report::summarize(lapTimes(stops, Stop::clipped)).median,
        .residual = residualOf(stops)};
    std::optional<Stop> below;
    for (const StopTimes& each : stops) {
        if (!isRung(each.stop)) continue;
        const std::vector<double> times = lapTimes(stops, each.stop);
        RungCost rung{.stop = each.stop, .time = report::summarize(times).median};
        rung.marginal = below ? difference(stops, each.stop, *below) : costOf(times);
        rung.share = rung.marginal.estimate / attribution.pass_time;
        attribution.rungs.push_back(rung);
        below = each.stop;
    }
    for (const Stop stop : {Stop::watched_vertex, Stop::watched_evaluation, Stop::watched_geometry})
        attribution.watching.emplace_back(stop, difference(stops, stop, Stop::fragment));
    return attribution;
}

namespace {

// ---- Warnings -----------------------------------------------------------------------------------

constexpr double kDiscardTolerance = 0.1;  // share of the geometry rung's time
constexpr double kClosureTolerance = 0.02;  // share of the pass's time; a smaller change is
                                            // irrelevant
constexpr double kWatchTolerance = 0.1;  // share of the stage's cost
constexpr double kWatchShare = 0.01;  // share of the pass's time: with many comparisons, some
                                      // exceed the limit by chance

// True if the whole interval is outside -limit ... limit; false with too few laps for an interval.
bool isBeyond(const Cost& cost, double limit) {
    return cost.interval && (cost.interval->lower > limit || cost.interval->upper < -limit);
}

std::string text(const Cost& cost) {
    std::string text = report::shortNumber(cost.estimate) + " ms";
    if (cost.interval)
        text += " (" + report::shortNumber(cost.interval->lower) + " to " +
                report::shortNumber(cost.interval->upper) + ')';
    return text;
}

// Sum of the marginal costs of these rungs.
double marginalOf(const Attribution& attribution, std::span<const Stop> rungs) {
    double sum = 0.0;
    for (const RungCost& rung : attribution.rungs)
        if (std::ranges::find(rungs, rung.stop) != rungs.end()) sum += rung.marginal.estimate;
    return sum;
}

double watchedStage(const Attribution& attribution, Stop watched) {
    if (watched == Stop::watched_vertex) return marginalOf(attribution, std::array{Stop::vertex});
    if (watched == Stop::watched_evaluation)
        return marginalOf(attribution, std::array{Stop::tessellation_1, Stop::tessellation});
    return marginalOf(attribution, std::array{Stop::geometry});
}

}  // namespace

std::vector<std::string> attributionWarnings(const Attribution& attribution) {
    std::vector<std::string> warnings;
    const Residual& residual = attribution.residual;
    for (const RungCost& rung : attribution.rungs) {
        if (rung.marginal.interval && rung.marginal.interval->upper < 0.0)
            warnings.push_back(
                std::string(stopName(rung.stop)) + ": the pass takes less with it than without, " +
                text(rung.marginal));
        if (rung.stop == Stop::geometry &&
            isBeyond(residual.discard, kDiscardTolerance * rung.time))
            warnings.push_back(
                "discarding primitives and clipping all of them differ by " +
                text(residual.discard) +
                ": the driver omits or adds work in one of them, so that the costs before and "
                "after the rasteriser are uncertain by as much");
    }
    if (isBeyond(residual.closure, kClosureTolerance * attribution.pass_time))
        warnings.push_back(
            "the pass differs from the top of the ladder, which draws the same, by " +
            text(residual.closure));
    for (const auto& [watched, cost] : attribution.watching) {
        const double stage = std::max(watchedStage(attribution, watched), 0.0);
        const double limit = std::max(kWatchTolerance * stage, kWatchShare * attribution.pass_time);
        if (cost.interval && cost.interval->lower > limit)
            warnings.push_back(
                std::string(stopName(watched)) + ": watching costs " + text(cost) +
                ", over a tenth of the stage's " + report::shortNumber(stage) + " ms");
    }
    return warnings;
}

namespace {

// ---- Costs per strand, segment, fragment --------------------------------------------------------

struct Unit {
    const char* name;
    std::optional<std::uint64_t> count;
    std::string note{};
};

// The unit of work of a stage.
Unit ownUnit(Stop rung, const WorkCounts& work) {
    switch (rung) {
    case Stop::vertex:
        return {"patch", work.patches};
    case Stop::tessellation_1:
        return {"evaluation", work.evaluations_1};
    case Stop::tessellation:
        if (!work.evaluations) break;
        return {"evaluation", *work.evaluations - work.evaluations_1.value_or(0)};
    case Stop::raster:
    case Stop::fragment:
        return {"fragment", work.fragments, work.fragments_note};
    case Stop::msaa:
        return {"sample", work.samples};
    default:
        break;
    }
    return {"", std::nullopt};
}

}  // namespace

std::vector<UnitCost> unitCosts(const std::vector<RungCost>& rungs, const WorkCounts& work) {
    std::vector<UnitCost> costs;
    for (const RungCost& rung : rungs) {
        if (rung.stop == Stop::empty) continue;
        for (const Unit& unit :
             {Unit{"strand", work.strands}, Unit{"segment", work.segments},
              ownUnit(rung.stop, work)}) {
            if (unit.count.value_or(0) == 0) continue;
            const double each = 1e6 * rung.marginal.estimate / static_cast<double>(*unit.count);
            costs.push_back({rung.stop, unit.name, *unit.count, each, unit.note});
        }
    }
    return costs;
}

// ---- Ablation -----------------------------------------------------------------------------------

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
