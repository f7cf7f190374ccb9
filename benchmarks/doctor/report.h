#pragma once

#include <string>
#include <vector>

#include "benchmarks/doctor/checks.h"
#include "benchmarks/doctor/sensitivity.h"
#include "benchmarks/report/report.h"

// Report of the doctor: findings, smallest detectable slowdowns, planted slowdowns.
namespace benchmarks::doctor {

inline constexpr const char* kDoctorSchema = "hairbench-doctor/2.0.0";

struct DoctorReport {
    report::Environment environment;
    std::vector<Finding> findings;
    std::vector<Sensitivity> sensitivities;  // --pairs
    std::vector<PlantedGate> planted;        // --planted
    bool interrupted = false;
};

// What the planted slowdowns say, as a row of the table: bad unless each was found, and in its own
// pass alone.
Finding judgePlanted(const std::vector<PlantedGate>& gates);

// Whether nothing is bad.
bool isTrusted(const DoctorReport& report);

// A table of the findings, a list of what to do about them, and what could be found here.
std::string doctorText(const DoctorReport& report);

// Indented JSON, described by results/doctor.schema.json.
std::string doctorReportText(const DoctorReport& report);

}  // namespace benchmarks::doctor
