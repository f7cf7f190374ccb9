#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hair/groom/strand_set.h"

namespace hair {

// Writes the format of import_hair.h: strands of 1 to 65,536 points, or all of any one number.
// Widths that are not known are a default thickness of 0, colours that are not known are white.
// Returns what is left out. Throws engine::Error where there are no strands or they are too long.
std::vector<std::string> exportHair(const StrandSet& strands, std::ostream& out);

}  // namespace hair
