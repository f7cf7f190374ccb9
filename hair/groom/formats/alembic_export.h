#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hair/groom/groom.h"
#include "hair/groom/strand_format.h"

// Strands as an Alembic archive (Ogawa): linear curves, "/hair/strands". importAlembic() reads
// them back equal to the last bit, except for transparencies, which have no place in it. Roots,
// groups, guides and colours are parameters with the names of Epic's "Using Alembic for Grooms"
// (version 1.5). The unit, the upward axis, root triangles and the comment are properties that
// only hairbench knows. Alembic has neither unit nor upward axis: points are written as they are.
namespace hair::groom {

// Equal strands make equal bytes: no date is written. Returns a warning for all data that is left
// out. Throws engine::Error if there are no strands, or one has 2^31 points.
std::vector<std::string> exportAlembic(const StrandSet& strands, std::ostream& out);
std::vector<std::string>
exportAlembicWith(const StrandSet& strands, const ExportExtras& extras, std::ostream& out);

}  // namespace hair::groom
