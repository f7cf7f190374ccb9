#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

// What the validation suite found out, as plain values.
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

}  // namespace benchmarks::physics
