#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "benchmarks/doctor/own_gate.h"
#include "benchmarks/metric.h"

namespace benchmarks {

// How much of /run/busy_work makes a pass slower by how much.
struct PlantedWork {
    std::string pass;
    std::uint32_t work = 0;
    double planted = 0.0;  // share of the pass's cost that it adds, as measured
};

// "POINTER=VALUE" that plant it.
std::vector<std::string> busySets(const std::string& pass, std::uint32_t work);

// Finds the work that adds this share to a pass's metric, by pairs of processes with and without.
// Throws engine::Error where no amount of it shows, Interrupted.
PlantedWork findBusyWork(const OwnGate& own, const MetricId& metric, double share);

}  // namespace benchmarks
