#include "benchmarks/physics/findings.h"

#include <algorithm>
#include <cmath>

namespace benchmarks::physics {

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

// What can't be measured has no error, and does not pass.
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

}  // namespace benchmarks::physics
