#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hair/groom/strand_set.h"

namespace hair {

// The ends of strands of `size` points each.
std::vector<std::uint32_t> uniformEnds(std::uint32_t strands, std::uint32_t size);

// How many points a format wants each strand to have.
struct NumberOfPoints {
    std::uint32_t least;
    std::uint32_t most;
    std::uint32_t wanted;  // of strands that have other numbers
};

// The strands resampled to one number of points, which a warning says; absent where they all have
// one, from `least` to `most`, already.
std::optional<StrandSet> makeUniform(
    const StrandSet& strands, const NumberOfPoints& number, std::vector<std::string>& warnings);

}  // namespace hair
