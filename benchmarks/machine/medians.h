#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/statistics.h"

namespace benchmarks {

// The median of one member over those that know it; absent where none does.
template <class Thing>
std::optional<double>
medianOf(const std::vector<Thing>& things, std::optional<double> Thing::* member) {
    std::vector<double> known;
    for (const Thing& thing : things)
        if (thing.*member) known.push_back(*(thing.*member));
    if (known.empty()) return std::nullopt;
    return summarize(known).median;
}

// Every throttle reason, each once, in the order in which they were first seen.
template <class Thing>
std::vector<std::string> everyReason(const std::vector<Thing>& things) {
    std::vector<std::string> reasons;
    for (const Thing& thing : things)
        for (const std::string& reason : thing.throttle_reasons)
            if (std::ranges::find(reasons, reason) == reasons.end()) reasons.push_back(reason);
    return reasons;
}

}  // namespace benchmarks
