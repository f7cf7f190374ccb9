#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/report/report.h"
#include "hair/fields.h"
#include "hair/settings.h"

// What the validation suite found out, as plain values, and its report, which
// results/physics.schema.json describes.
namespace benchmarks::physics {

// Only what a solver promises is gated, and passes or fails. Anything else that could be measured
// is reported: how far a solver is from theory is a result too. Skipped: it can't be measured.
enum class Verdict { pass, fail, reported, skipped };

const char* verdictName(Verdict verdict);

struct Parameter {
    std::string name;
    double value = 0.0;
    std::string unit;
};

// What is measured, and under which circumstances.
struct Quantity {
    std::string name;
    std::string unit;
    std::vector<Parameter> parameters{};
};

struct Outcome {
    std::string check;
    std::string solver;
    Quantity quantity;  // of a skipped check: no name
    // Not finite: it could not be measured, for `reason`.
    double measured = std::numeric_limits<double>::quiet_NaN();
    std::optional<double> expected;
    std::optional<double> error;  // |measured / expected - 1|, or measured where that is an error
    std::optional<double> tolerance;  // the greatest error that passes
    Verdict verdict = Verdict::reported;
    std::string reason;  // why it was skipped or not measured
    std::string state_hash;
};

// A column of a curve.
struct Series {
    std::string name;
    std::string unit;
};

// Rows of numbers for a figure.
struct Curve {
    std::string check;
    std::string solver;
    std::string name;
    std::vector<Series> columns;
    std::vector<std::vector<double>> rows;
};

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

inline constexpr const char* kPhysicsSchema = "hairbench-physics/1.0.0";

struct PhysicsReport {
    report::Environment environment;
    std::vector<Outcome> outcomes;
    std::vector<Curve> curves;
    bool interrupted = false;  // the last check may be missing
};

// Indented JSON. What is not known is absent.
std::string physicsReportText(const PhysicsReport& report);

// For a terminal: a line on the device, then the outcomes by check, and how many passed.
std::string physicsTable(const PhysicsReport& report);

// kCheckFailed where a check failed, kNothingRan where none could be carried out, kInterrupted.
int exitStatus(const PhysicsReport& report);

}  // namespace benchmarks::physics
