#pragma once

#include <cstdint>
#include <span>

#include "hair/groom/strand_set.h"

namespace hair {

// The strands of these indices, in this order and with what they have; one may come more than once.
// Without the root triangles, whose corners may be gone.
// Throws engine::Error if there are 2^32 points or more.
StrandSet pickStrands(const StrandSet& strands, std::span<const std::uint32_t> indices);

// Points and widths times `factor`. What a file says of its unit stays.
StrandSet scaleLengths(StrandSet strands, double factor);

}  // namespace hair
