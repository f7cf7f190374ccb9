#pragma once

#include <cstdint>
#include <vector>

#include "hair/groom/groom.h"

namespace hair {

// Binds every strand of a dense groom to three of its guides, whose roots are near and whose mean
// is like it. `guides` are the dense strands, in ascending order, that became the guides 0, 1, …:
// each is bound to itself alone. With fewer than three guides some of the three are the same.
std::vector<StrandBinding>
bindStrands(const Groom& dense, const std::vector<std::uint32_t>& guides);

// How far the strands that the guides and bindings give are from those of the dense groom, vertex
// against vertex.
struct ReconstructionError {
    double mean = 0.0;      // m
    double rms = 0.0;       // m
    double percentile95 = 0.0;  // m, of the strands' own means
    double maximum = 0.0;   // m
    double relative = 0.0;  // mean / mean strand length
};

ReconstructionError reconstructionError(
    const Groom& dense, const Groom& guides, const std::vector<StrandBinding>& bindings);

}  // namespace hair
