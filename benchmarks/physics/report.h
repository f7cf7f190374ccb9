#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/report/report.h"
#include "hair/fields.h"
#include "hair/settings.h"

// The results of the validation suite as plain values, and its report. results/physics.schema.json
// describes the report.
namespace benchmarks::physics {

// Only a solver's promises are gated and pass or fail. Other measurements are reported, because a
// solver's distance from theory is a result too. Skipped: it cannot be measured.
enum class Verdict { pass, fail, reported, skipped };

const char* verdictName(Verdict verdict);

struct Parameter {
    std::string name;
    double value = 0.0;
    std::string unit;
};

// A measured quantity and its circumstances.
struct Quantity {
    std::string name;
    std::string unit;
    std::vector<Parameter> parameters{};
};

struct Outcome {
    std::string check;
    std::string solver;
    Quantity quantity;  // a skipped check has no name
    // Not finite if it could not be measured; `reason` tells why.
    double measured = std::numeric_limits<double>::quiet_NaN();
    std::optional<double> expected;
    std::optional<double> error;  // |measured / expected - 1|, or `measured` if that is itself an
                                  // error
    std::optional<double> tolerance;  // the greatest error that passes
    Verdict verdict = Verdict::reported;
    std::string reason;  // reason for skipping or for a missing measurement
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

// The names of the solvers that can be checked: all except `none`, in the order of the settings.
const std::vector<hair::Named<hair::Solver>>& checkedSolvers();
std::string nameOf(hair::Solver solver);

// The results of one check for one solver. An outcome with a tolerance is a gate. Callers may add a
// reason or a hash to the returned outcome.
class Findings {
public:
    Findings(std::string check, hair::Solver solver)
        : check_(std::move(check)), solver_(nameOf(solver)) {}

    // Compares with a value from theory; the error is relative to it.
    Outcome& compare(
        Quantity quantity, double measured, double expected, std::optional<double> tolerance = {});

    // Adds a quantity that is itself an error.
    Outcome& deviation(Quantity quantity, double measured, std::optional<double> tolerance = {});

    // Adds a quantity without a theoretical value.
    Outcome& value(Quantity quantity, double measured);

    void skip(std::string reason);
    // Records that the check itself could not be carried out.
    void fail(std::string reason);

    // Omits rows with a number that is not finite.
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

// Indented JSON. Unknown values are absent.
std::string physicsReportText(const PhysicsReport& report);

// Text for a terminal: a line on the device, the outcomes by check, and the number of passes.
std::string physicsTable(const PhysicsReport& report);

// kCheckFailed if a check failed, kNothingRan if none could be carried out, kInterrupted, or kOk.
int exitStatus(const PhysicsReport& report);

}  // namespace benchmarks::physics
