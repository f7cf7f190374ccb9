#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hair/groom/strand_set.h"

namespace hair {

// Writes what import_ply.h reads: little-endian, strands as chains of edges. As StrandExporter
// says.
std::vector<std::string> exportPly(const StrandSet& strands, std::ostream& out);

}  // namespace hair
