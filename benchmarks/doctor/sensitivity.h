#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/gate/blocks.h"
#include "benchmarks/report/metric.h"

// How small a slowdown a gate can find on this machine.
namespace benchmarks::doctor {

// How small a slowdown of one metric a gate can find on this machine.
struct Sensitivity {
    report::MetricId metric;  // of the doctor's scene
    // Tau, a share: three standard deviations of an A/A pair, at least 2 %.
    double decisive_change = 0.0;
    double smallest_slowdown = 0.0;  // share that 48 pairs find in nine of ten gates
    std::vector<double> differences{};  // ln(A2/A1) of the pairs
};

// Pairs of processes of this very program with itself, on the doctor's scene: the times of the
// frame and of every pass that is not too short to judge, by the wall clock, by CPU time and in
// instructions where there are such. Throws Interrupted.
std::vector<Sensitivity>
measureSensitivity(const engine::DeviceOptions& device, std::uint32_t pairs);

// A gate of this program against itself with a slowdown in one pass.
struct PlantedGate {
    std::string pass;
    double planted = 0.0;    // share of the pass's cost that was added
    bool found = false;      // the pass regressed ...
    bool elsewhere = false;  // ... and some other pass too, which nothing was added to
};

// Plants 1.5 times the smallest slowdown of the pass that is known best, with /run/busy_pass, and
// gates it so often, with the calibration of `sensitivities`. Throws Interrupted; engine::Error
// where no pass can be slowed down.
std::vector<PlantedGate> plantSlowdowns(
    const engine::DeviceOptions& device, const std::vector<Sensitivity>& sensitivities,
    std::uint32_t gates);

// The smallest slowdown of one metric, a share, that a gate of 48 pairs calls a regression in nine
// of ten gates on a machine whose pairs of one build differ by `differences` = ln(A2/A1), where
// `decisive_change` is tau and nothing else of the gate's `metrics` is slower, so that it has to
// hold against the strictest step of Benjamini and Hochberg.
//
// A gate is drawn as 48 of the differences, with replacement, either sign being as likely in pairs
// of one build. A slowdown s moves all 48 by ln(1 + s), so that the gate finds it if the lower end
// of the 48's signed-rank interval, at the level of the last decision, is above ln(1 + tau) -
// ln(1 + s). The result is the s for which that is so in 90 % of the draws. At least two
// differences or engine::Error. The draws are the same every time.
double
smallestSlowdown(std::span<const double> differences, double decisive_change, std::size_t metrics);

}  // namespace benchmarks::doctor
