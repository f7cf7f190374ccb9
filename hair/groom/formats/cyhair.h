#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hair/groom/groom.h"
#include "hair/groom/strand_format.h"

// Cem Yuksel's hair models, cemyuksel.com/research/hairmodels. Little-endian: a header of 128
// bytes, then the arrays that its bits name, without padding:
//   uint16 segments[hair_count]           1 less than the strand's points
//   float32 points[point_count][3]
//   float32 thickness[point_count]        diameters
//   float32 transparency[point_count]
//   float32 colors[point_count][3]
// Without an array, the header's value holds everywhere. The format states no unit.
namespace hair::groom {

// Writes strands of 1 to 65,536 points, or of any number if all have the same. Unknown widths
// become a default thickness of 0, unknown colours white. Returns a warning for all data that is
// left out. Throws engine::Error if there are no strands or they are too long.
std::vector<std::string> exportHair(const StrandSet& strands, std::ostream& out);

// Refuses files that are not exactly of the format: no strands, no points, an unknown array,
// segments that don't add up to the points, a size that doesn't match the header (checked before
// any allocation), a number that is not finite. A thickness of 0 in the
// header means that widths are not known. Throws engine::Error "byte N: reason".
StrandSet importHair(const StrandFile& file);

}  // namespace hair::groom
