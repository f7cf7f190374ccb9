#include "benchmarks/physics/report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include <nlohmann/json.hpp>

#include "benchmarks/report/change.h"
#include "benchmarks/report/text.h"

namespace benchmarks::physics {

// ---- Findings of a check ------------------------------------------------------------------------

const char* verdictName(Verdict verdict) {
    switch (verdict) {
    case Verdict::pass:
        return "pass";
    case Verdict::fail:
        return "fail";
    case Verdict::reported:
        return "reported";
    case Verdict::skipped:
        return "skipped";
    }
    return "fail";
}

const std::vector<hair::Named<hair::Solver>>& checkedSolvers() {
    static const auto solvers = [] {
        hair::SimulationSettings settings;
        const hair::Field& field = hair::fieldAt(settings, &settings.solver);
        const auto& row = std::get<hair::Choice>(field.kind);
        std::vector<hair::Named<hair::Solver>> named;
        for (std::size_t i = 0; i < row.names.size(); ++i) {
            row.choose(settings, i);
            if (settings.solver != hair::Solver::none)
                named.push_back({settings.solver, row.names[i].name});
        }
        return named;
    }();
    return solvers;
}

std::string nameOf(hair::Solver solver) {
    const auto& all = checkedSolvers();
    const auto found = std::ranges::find(all, solver, &hair::Named<hair::Solver>::value);
    return found == all.end() ? "none" : found->name;
}

Outcome& Findings::compare(
    Quantity quantity, double measured, double expected, std::optional<double> tolerance) {
    return add(
        {.quantity = std::move(quantity),
         .measured = measured,
         .expected = expected,
         .error = std::abs(measured / expected - 1.0),
         .tolerance = tolerance});
}

Outcome& Findings::deviation(Quantity quantity, double measured, std::optional<double> tolerance) {
    return add(
        {.quantity = std::move(quantity),
         .measured = measured,
         .error = measured,
         .tolerance = tolerance});
}

Outcome& Findings::value(Quantity quantity, double measured) {
    return add({.quantity = std::move(quantity), .measured = measured});
}

void Findings::skip(std::string reason) {
    outcomes_.push_back(
        {.check = check_,
         .solver = solver_,
         .verdict = Verdict::skipped,
         .reason = std::move(reason)});
}

void Findings::fail(std::string reason) {
    skip(std::move(reason));
    outcomes_.back().verdict = Verdict::fail;
}

void Findings::curve(
    std::string name, std::vector<Series> columns, std::vector<std::vector<double>> rows) {
    std::erase_if(rows, [](const std::vector<double>& row) {
        return !std::ranges::all_of(row, [](double number) { return std::isfinite(number); });
    });
    curves_.push_back({check_, solver_, std::move(name), std::move(columns), std::move(rows)});
}

// A quantity that cannot be measured has no error and does not pass.
Outcome& Findings::add(Outcome outcome) {
    outcome.check = check_;
    outcome.solver = solver_;
    if (!std::isfinite(outcome.measured)) outcome.reason = "not a number";
    if (outcome.error && !std::isfinite(*outcome.error)) outcome.error.reset();
    if (outcome.tolerance)
        outcome.verdict =
            outcome.error && *outcome.error <= *outcome.tolerance ? Verdict::pass : Verdict::fail;
    return outcomes_.emplace_back(std::move(outcome));
}

namespace {

// ---- JSON ---------------------------------------------------------------------------------------

scene::Json toJson(const Outcome& outcome) {
    scene::Json object = {{"check", outcome.check}, {"solver", outcome.solver}};
    if (!outcome.quantity.name.empty()) {
        object["quantity"] = outcome.quantity.name;
        object["unit"] = outcome.quantity.unit;
        scene::Json& parameters = object["parameters"] = scene::Json::object();
        for (const Parameter& each : outcome.quantity.parameters)
            parameters[each.name] = {{"value", each.value}, {"unit", each.unit}};
    }
    if (std::isfinite(outcome.measured)) object["measured"] = outcome.measured;
    if (outcome.expected) object["expected"] = *outcome.expected;
    if (outcome.error) object["error"] = *outcome.error;
    if (outcome.tolerance && std::isfinite(*outcome.tolerance))
        object["tolerance"] = *outcome.tolerance;
    object["verdict"] = verdictName(outcome.verdict);
    if (!outcome.reason.empty()) object["reason"] = outcome.reason;
    if (!outcome.state_hash.empty()) object["state_hash"] = outcome.state_hash;
    return object;
}

scene::Json toJson(const Curve& curve) {
    scene::Json object = {{"check", curve.check}, {"solver", curve.solver}, {"name", curve.name}};
    scene::Json& columns = object["columns"] = scene::Json::array();
    for (const Series& each : curve.columns)
        columns.push_back({{"name", each.name}, {"unit", each.unit}});
    object["rows"] = curve.rows;
    return object;
}

}  // namespace

std::string physicsReportText(const PhysicsReport& report) {
    scene::Json object = scene::Json::object();
    object["schema"] = kPhysicsSchema;
    object["environment"] = report::environmentJson(report.environment);
    object["interrupted"] = report.interrupted;
    scene::Json& outcomes = object["outcomes"] = scene::Json::array();
    for (const Outcome& outcome : report.outcomes) outcomes.push_back(toJson(outcome));
    scene::Json& curves = object["curves"] = scene::Json::array();
    for (const Curve& curve : report.curves) curves.push_back(toJson(curve));
    // Output of drivers and commands need not be UTF-8.
    return object.dump(2, ' ', false, scene::Json::error_handler_t::replace) + '\n';
}

namespace {

// ---- Table for a terminal -----------------------------------------------------------------------

// Errors range from 1e-8 to 1, so three significant digits are shown for any size.
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
                (count ? std::to_string(std::lround(each.value)) : report::shortNumber(each.value));
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

std::vector<report::Column> columns(const std::vector<Outcome>& outcomes) {
    std::vector<report::Column> all{{"check", false}, {"solver", false}, {"quantity", false},
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
    const report::DeviceRecord& device = report.environment.device;
    std::string text = (device.name.empty() ? "unknown device" : device.name) + ", " +
                       device.driver + ' ' + device.driver_version + '\n';
    const std::vector<report::Column> all = columns(report.outcomes);
    text += report::columnsLine(all, 0);
    for (std::size_t i = 0; i < report.outcomes.size(); ++i) {
        if (i > 0 && report.outcomes[i].check != report.outcomes[i - 1].check) text += '\n';
        text += report::columnsLine(all, i + 1);
    }
    return text + '\n' + counts(report.outcomes);
}

int exitStatus(const PhysicsReport& report) {
    if (report.interrupted) return report::kInterrupted;
    const auto has = [&](Verdict verdict) {
        return std::ranges::find(report.outcomes, verdict, &Outcome::verdict) !=
               report.outcomes.end();
    };
    if (has(Verdict::fail)) return report::kCheckFailed;
    return has(Verdict::pass) || has(Verdict::reported) ? report::kOk : report::kNothingRan;
}

}  // namespace benchmarks::physics
