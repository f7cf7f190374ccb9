#include <array>
#include <cstdio>

#include "benchmarks/ablate/ablation_text.h"
#include "benchmarks/columns.h"
#include "benchmarks/table.h"

namespace benchmarks {

namespace {

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
    return shortNumber(cost.interval->lower) + " .. " + shortNumber(cost.interval->upper);
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

std::string unitCell(const UnitCost* cost) { return cost ? shortNumber(cost->nanoseconds) : "-"; }

// Per what the stage handles one by one.
std::string ownUnitCell(const CaseAblation& ablation, Stop rung) {
    for (const UnitCost& each : ablation.unit_costs) {
        if (each.rung != rung || each.unit == "strand" || each.unit == "segment") continue;
        return shortNumber(each.nanoseconds) + " / " + each.unit +
               (each.note.empty() ? "" : " (" + each.note + ')');
    }
    return {};
}

std::vector<Column> columns(const CaseAblation& ablation) {
    std::vector<Column> all{{"rung", false}, {"time, ms"},    {"marginal, ms"}, {"95 % interval"},
                            {"share, %"},    {"ns / strand"}, {"ns / segment"}, {"ns", false}};
    for (std::size_t i = 0; i < ablation.attribution->rungs.size(); ++i) {
        const RungCost& rung = ablation.attribution->rungs[i];
        const std::array cells{
            rungTitle(ablation.stops[i]),
            shortNumber(rung.time),
            shortNumber(rung.marginal.estimate),
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
    std::string line = std::string(what) + ": " + shortNumber(cost.estimate) + " ms";
    if (cost.interval) line += " (" + intervalCell(cost) + ')';
    return line + '\n';
}

std::string rest(const Attribution& attribution) {
    std::string text = "the pass as it always is: " + shortNumber(attribution.pass_time) + " ms\n";
    const Residual& residual = attribution.residual;
    text += costLine("  less all marginal costs", residual.closure);
    text +=
        "all primitives clipped instead of discarded: " + shortNumber(attribution.clipped_time) +
        " ms\n";
    text += costLine("  less the geometry rung", residual.discard);
    if (residual.multisampling)
        text +=
            costLine("samples' cost with a fragment shader less without", *residual.multisampling);
    text += costLine("interaction residual, the sum of these", residual.interaction);
    for (const auto& [stop, cost] : attribution.watching) text += costLine(stopName(stop), cost);
    return text;
}

}  // namespace

std::string ablationTable(const CaseAblation& ablation) {
    std::string text = ablation.name + '\n';
    if (ablation.status != Status::ok)
        return text + statusName(ablation.status) + ": " + ablation.reason + '\n';
    if (ablation.attribution) {
        const std::vector<Column> all = columns(ablation);
        for (std::size_t row = 0; row <= ablation.attribution->rungs.size(); ++row)
            text += columnsLine(all, row);
        text += rest(*ablation.attribution);
    }
    for (const std::string& warning : ablation.warnings) text += "warning: " + warning + '\n';
    return text;
}

}  // namespace benchmarks
