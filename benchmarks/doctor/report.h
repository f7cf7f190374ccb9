#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/doctor/checks.h"
#include "benchmarks/gate/blocks.h"
#include "benchmarks/report/metric.h"
#include "benchmarks/report/report.h"

// The smallest slowdown that a gate can find on this machine.

namespace benchmarks::doctor {

// The smallest slowdown of one metric that a gate can find on this machine.
struct Sensitivity {
    report::MetricId metric;  // of the doctor's scene
    // Tau, as a share: three standard deviations of an A/A pair, at least 2 %.
    double decisive_change = 0.0;
    double smallest_slowdown = 0.0;  // share that 48 pairs find in nine of ten gates
    std::vector<double> differences{};  // ln(A2/A1) of the pairs
};

// Runs pairs of processes of this program against itself, on the doctor's scene. Measures the times
// of the frame and of every pass that is long enough: by wall clock, by CPU time and, where
// available, in instructions. Throws Interrupted.
std::vector<Sensitivity>
measureSensitivity(const engine::DeviceOptions& device, std::uint32_t pairs);

// A gate of this program against itself with a slowdown in one pass.
struct PlantedGate {
    std::string pass;
    double planted = 0.0;  // added share of the pass's cost
    bool found = false;  // the pass regressed
    bool elsewhere = false;  // some other pass regressed too, without added work
};

// Plants 1.5 times the smallest slowdown of the most precise pass, with /run/busy_pass, and gates
// it `gates` times with the calibration of `sensitivities`. Throws Interrupted, and engine::Error
// if no pass can be slowed down.
std::vector<PlantedGate> plantSlowdowns(
    const engine::DeviceOptions& device, const std::vector<Sensitivity>& sensitivities,
    std::uint32_t gates);

// The smallest slowdown of one metric, as a share, that a gate of 48 pairs calls a regression in
// nine of ten gates. Pairs of one build on the machine differ by `differences` = ln(A2/A1), and
// `decisive_change` is tau. None of the gate's other `metrics` is slower, so the slowdown must pass
// the strictest step of Benjamini and Hochberg.
//
// A gate is simulated by drawing 48 of the differences, with replacement and random signs, since
// both signs are equally likely in pairs of one build. A slowdown s shifts all 48 by ln(1 + s). The
// gate finds it if the lower end of their signed-rank interval, at the level of the last decision,
// is above ln(1 + tau) - ln(1 + s). The result is the s for which this holds in 90 % of the draws.
// Throws engine::Error for fewer than two differences. The draws are the same every time.
double
smallestSlowdown(std::span<const double> differences, double decisive_change, std::size_t metrics);

// Report of the doctor: findings, smallest detectable slowdowns, planted slowdowns.

inline constexpr const char* kDoctorSchema = "hairbench-doctor/2.1.0";

struct DoctorReport {
    report::Environment environment;
    std::vector<Finding> findings;
    std::vector<Sensitivity> sensitivities;  // --pairs
    std::vector<PlantedGate> planted;  // --planted
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
