#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hair/groom/strand_set.h"

namespace hair {

// Text of Universal Scene Description: one linear BasisCurves, "/hair". It holds all that strands
// may have, so that nothing is left out.
std::vector<std::string> exportUsda(const StrandSet& strands, std::ostream& out);

}  // namespace hair
