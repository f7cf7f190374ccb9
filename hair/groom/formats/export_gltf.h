#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hair/groom/strand_set.h"

namespace hair {

// Writes what import_gltf_strands.h reads: one LINES primitive, and a node that scales to metres
// where the strands' unit is known to be another. As StrandExporter says.
std::vector<std::string> exportGltf(const StrandSet& strands, std::ostream& out);  // data in JSON
std::vector<std::string> exportGlb(const StrandSet& strands, std::ostream& out);  // binary

}  // namespace hair
