#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/ablate/attribution.h"

namespace benchmarks {

// How much of everything there was. What is not known is absent.
struct WorkCounts {
    std::optional<std::uint64_t> patches;
    std::optional<std::uint64_t> strands;
    std::optional<std::uint64_t> segments;  // drawn
    std::optional<std::uint64_t> evaluations_1;  // at one segment a guide segment
    std::optional<std::uint64_t> evaluations;
    std::optional<std::uint64_t> fragments;  // at one sample
    std::optional<std::uint64_t> samples;  // with the case's, above 1
    std::string fragments_note;  // empty: exact
};

// A rung's marginal cost per thing that it does more than the rung below, or over which it is
// spread.
struct UnitCost {
    Stop rung = Stop::empty;
    std::string unit;  // "strand", "segment", "patch", "evaluation", "fragment", "sample"
    std::uint64_t count = 0;
    double nanoseconds = 0.0;
    std::string note;  // empty: the count is exact
};

// Per strand and segment for all but the empty rung, and per what the stage handles.
std::vector<UnitCost> unitCosts(const std::vector<RungCost>& rungs, const WorkCounts& work);

}  // namespace benchmarks
