#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include "benchmarks/columns.h"
#include "benchmarks/physics/report.h"
#include "benchmarks/table.h"

namespace benchmarks::physics {

namespace {

// Errors range from 1e-8 to 1: three digits whatever their size.
std::string figure(std::optional<double> number) {
    if (!number || !std::isfinite(*number)) return "-";
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", *number);
    return text;
}

std::string circumstances(const Quantity& quantity) {
    std::string text;
    for (const Parameter& each : quantity.parameters) {
        const bool count = each.unit == "count";
        text += (text.empty() ? "" : ", ") + each.name + ' ' +
                (count ? std::to_string(std::lround(each.value)) : shortNumber(each.value));
        if (each.unit != "1" && !count) text += ' ' + each.unit;
    }
    return text;
}

std::string verdictCell(const Outcome& outcome) {
    std::string text = verdictName(outcome.verdict);
    if (!outcome.reason.empty()) text += ": " + outcome.reason;
    return text;
}

std::string quantityCell(const Quantity& quantity) {
    if (quantity.unit.empty() || quantity.unit == "1") return quantity.name;
    return quantity.name + ", " + quantity.unit;
}

std::vector<Column> columns(const std::vector<Outcome>& outcomes) {
    std::vector<Column> all{{"check", false}, {"solver", false}, {"quantity", false},
                            {"with", false},  {"measured"},      {"expected"},
                            {"error"},        {"tolerance"},     {"verdict", false}};
    for (const Outcome& each : outcomes) {
        const std::array cells{
            each.check,
            each.solver,
            quantityCell(each.quantity),
            circumstances(each.quantity),
            figure(each.measured),
            figure(each.expected),
            figure(each.error),
            figure(each.tolerance),
            verdictCell(each)};
        for (std::size_t i = 0; i < all.size(); ++i) all[i].cells.push_back(cells[i]);
    }
    return all;
}

std::string counts(const std::vector<Outcome>& outcomes) {
    std::string text;
    for (const Verdict verdict :
         {Verdict::pass, Verdict::fail, Verdict::reported, Verdict::skipped}) {
        const auto count = std::ranges::count(outcomes, verdict, &Outcome::verdict);
        text += (text.empty() ? "" : ", ") + std::to_string(count) + ' ' + verdictName(verdict);
    }
    return text + '\n';
}

}  // namespace

std::string physicsTable(const PhysicsReport& report) {
    const DeviceRecord& device = report.environment.device;
    std::string text = (device.name.empty() ? "unknown device" : device.name) + ", " +
                       device.driver + ' ' + device.driver_version + '\n';
    const std::vector<Column> all = columns(report.outcomes);
    text += columnsLine(all, 0);
    for (std::size_t i = 0; i < report.outcomes.size(); ++i) {
        if (i > 0 && report.outcomes[i].check != report.outcomes[i - 1].check) text += '\n';
        text += columnsLine(all, i + 1);
    }
    return text + '\n' + counts(report.outcomes);
}

}  // namespace benchmarks::physics
