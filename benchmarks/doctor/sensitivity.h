#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "benchmarks/gate/side.h"
#include "benchmarks/metric.h"

namespace benchmarks {

// How small a slowdown of one metric a gate can find on this machine.
struct Sensitivity {
    MetricId metric;  // of the doctor's scene
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

}  // namespace benchmarks
