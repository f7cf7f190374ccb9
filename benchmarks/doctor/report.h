#pragma once

#include <string>
#include <vector>

#include "benchmarks/doctor/checks.h"
#include "benchmarks/doctor/sensitivity.h"
#include "benchmarks/report/report.h"

// Report of the doctor: findings, smallest detectable slowdowns, planted slowdowns.
namespace benchmarks::doctor {

inline constexpr const char* kDoctorSchema = "hairbench-doctor/2.1.0";

struct DoctorReport {
    report::Environment environment;
    std::vector<Finding> findings;
    std::vector<Sensitivity> sensitivities;  // --pairs
    std::vector<PlantedGate> planted;        // --planted
    bool interrupted = false;
};

// The result of the planted slowdowns as a row of the table. It is bad unless each was found, and
// only in its own pass.
Finding judgePlanted(const std::vector<PlantedGate>& gates);

// True if no finding is bad.
bool isTrusted(const DoctorReport& report);

// A table of the findings, the list of remedies, and the detectable slowdowns.
std::string doctorText(const DoctorReport& report);

// Indented JSON, described by results/doctor.schema.json.
std::string doctorReportText(const DoctorReport& report);

}  // namespace benchmarks::doctor
