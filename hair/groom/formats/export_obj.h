#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hair/groom/strand_set.h"

namespace hair {

// Writes what import_obj.h reads, in the shortest decimals that give the same floats. As
// StrandExporter says.
std::vector<std::string> exportObj(const StrandSet& strands, std::ostream& out);

}  // namespace hair
