#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hair/groom/strand_set.h"

namespace hair {

// Writes the format of import_hgl.h, which has a place for points and root triangles. Strands of
// differing numbers of points, or of others than 2 to 256, are resampled. Returns what is not
// written as it is. Throws engine::Error where there are no strands, or too many of them.
std::vector<std::string> exportHgl(const StrandSet& strands, std::ostream& out);

}  // namespace hair
