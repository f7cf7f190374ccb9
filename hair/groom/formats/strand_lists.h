#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hair/groom/files.h"
#include "hair/groom/groom.h"

// Two formats of research on hair, which list strand after strand and have no header. Both are
// little-endian and state no unit:
//   int32 strands
//   for each strand: int32 points, then so many points
// .data has points of float32[3]: USC-HairSalon (Hu et al. 2015, Single-view hair modeling using a
// hairstyle database), the Hair Photobooth (Paris et al. 2008) and what is trained with them.
// .bin has points of float32[7]: position, tangent or colour, and a label that is always 0; CT2Hair
// (Shen et al. 2023, CT2Hair: high-fidelity 3D hair modeling using computed tomography).
namespace hair::groom {

// Returns what is left out. Throws engine::Error where there are no strands or more of them than
// an int32 counts.
std::vector<std::string> exportHairData(const StrandSet& strands, std::ostream& out);

// A strand of no points is left out with a warning. Refuses whatever is not exactly such a list: no
// strands with points, negative counts, counts that the file is too short for (looked at before
// anything is allocated), trailing bytes, numbers that are not finite.
// Throws engine::Error "byte N: reason".
StrandSet importHairData(const StrandFile& file);

// As CT2Hair's own reader does, strands with a position that is not a number and those of fewer
// than 5 points are left out, with warnings; infinite positions are refused. Of a point its
// position alone is read: whether it has a tangent or a colour beside it, the file doesn't say.
StrandSet importCt2Hair(const StrandFile& file);

}  // namespace hair::groom
