#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "hair/groom/inspect.h"
#include "hair/groom/strand_set.h"

namespace benchmarks {

// Something about a groom that its maker may not have meant.
struct Oddity {
    std::string_view name;    // snake_case
    std::uint64_t count = 0;  // of the things that are odd
    std::string what;
    std::string advice;
};

std::vector<Oddity>
findOddities(const hair::StrandSet& strands, const hair::StrandFindings& findings);

}  // namespace benchmarks
