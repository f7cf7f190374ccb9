#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hair/groom/files.h"
#include "hair/groom/groom.h"

// Cem Yuksel's hair models, cemyuksel.com/research/hairmodels. Little-endian: a header of 128
// bytes, then those of these arrays that its bits name, with nothing between them:
//   uint16 segments[hair_count]           1 less than the strand's points
//   float32 points[point_count][3]
//   float32 thickness[point_count]        diameters
//   float32 transparency[point_count]
//   float32 colors[point_count][3]
// What has no array has the header's value everywhere. The format states no unit.
namespace hair::groom {

// Writes strands of 1 to 65,536 points, or all of any one number. Widths that are not known are a
// default thickness of 0, colours that are not known are white. Returns what is left out. Throws
// engine::Error where there are no strands or they are too long.
std::vector<std::string> exportHair(const StrandSet& strands, std::ostream& out);

// Refuses whatever is not exactly such a file: no strands, no points, an unknown array, segments
// that don't add up to the points, a size that the header doesn't give (looked at before anything
// is allocated), a number that is not finite, a negative thickness. A header's thickness of 0 means
// that widths are not known. Throws engine::Error "byte N: reason".
StrandSet importHair(const StrandFile& file);

}  // namespace hair::groom
