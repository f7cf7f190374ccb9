#pragma once

#include <optional>
#include <string>
#include <vector>

#include "benchmarks/physics/outcome.h"
#include "hair/fields.h"
#include "hair/settings.h"

namespace benchmarks::physics {

// The names of the solvers that can be checked: all but `none`, in the order of the settings.
const std::vector<hair::Named<hair::Solver>>& checkedSolvers();
std::string nameOf(hair::Solver solver);

// What one check finds out about one solver. A tolerance makes a gate of an outcome. The returned
// outcome may be given a reason or a hash.
class Findings {
public:
    Findings(std::string check, hair::Solver solver)
        : check_(std::move(check)), solver_(nameOf(solver)) {}

    // Against a value from theory; the error is relative to it.
    Outcome& compare(
        Quantity quantity, double measured, double expected, std::optional<double> tolerance = {});

    // A quantity that is an error itself.
    Outcome& deviation(Quantity quantity, double measured, std::optional<double> tolerance = {});

    // A quantity that theory says nothing of.
    Outcome& value(Quantity quantity, double measured);

    void skip(std::string reason);
    // The check itself could not be carried out.
    void fail(std::string reason);

    // Rows with a number that is not finite are left out.
    void
    curve(std::string name, std::vector<Series> columns, std::vector<std::vector<double>> rows);

    const std::vector<Outcome>& outcomes() const { return outcomes_; }
    const std::vector<Curve>& curves() const { return curves_; }

private:
    Outcome& add(Outcome outcome);

    std::string check_;
    std::string solver_;
    std::vector<Outcome> outcomes_;
    std::vector<Curve> curves_;
};

}  // namespace benchmarks::physics
