#pragma once

#include <string>
#include <vector>

#include "benchmarks/physics/outcome.h"
#include "benchmarks/report.h"

// What the validation suite found out, and its JSON: results/physics.schema.json describes it.
namespace benchmarks::physics {

inline constexpr const char* kPhysicsSchema = "hairbench-physics/1.0.0";

struct PhysicsReport {
    Environment environment;
    std::vector<Outcome> outcomes;
    std::vector<Curve> curves;
    bool interrupted = false;  // the last check may be missing
};

// Indented JSON. What is not known is absent.
std::string physicsReportText(const PhysicsReport& report);

// For a terminal: a line on the device, then the outcomes by check, and how many passed.
std::string physicsTable(const PhysicsReport& report);

}  // namespace benchmarks::physics
