#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/ablate/ladder.h"
#include "benchmarks/report.h"
#include "engine/pipeline_statistics.h"
#include "hair/rendering/strand_plan.h"

namespace benchmarks {

// What the strands pass of a stop did in untimed frames. Absent where the device doesn't count.
struct StopCounts {
    std::optional<engine::StatisticCounts> statistics;
    std::optional<std::uint64_t> samples_passed;  // the depth test
    std::optional<std::uint64_t> seen;  // invocations of the watched stage, by its own count
};

// What was counted, with what the plan implies where it implies something: of stages that the stop
// has; counters of absent stages are undefined, so that only what is expected is listed.
std::vector<Statistic> stopStatistics(
    const StopPlan& stop, const hair::StrandPlan& plan, const StopCounts& counts,
    bool approximate_fragments);

// Where they differ: a driver that left out a stage that it should have run, or ran one that it
// shouldn't. "geometry: geometry_invocations: 0, expected 243712".
std::vector<std::string> countWarnings(const StopPlan& stop, std::span<const Statistic> statistics);

// A statistic of the strands pass.
std::uint64_t countOf(const engine::StatisticCounts& counts, std::string_view name);

}  // namespace benchmarks
