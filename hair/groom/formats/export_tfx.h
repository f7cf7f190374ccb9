#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hair/groom/strand_set.h"

namespace hair {

// Writes the format of import_tfx.h, arrays at multiples of 8 bytes. Each strand has one width,
// that of its root; its first two vertices are fixed, as AMD's exporters do it. Strands of
// differing numbers of points are resampled to a number that TressFX takes: 4, 8, 16, 32 or 64.
// Returns what is not written as it is. Throws engine::Error where there are no strands, or more
// bytes than 32-bit offsets reach.
std::vector<std::string> exportTfx(const StrandSet& strands, std::ostream& out);

}  // namespace hair
