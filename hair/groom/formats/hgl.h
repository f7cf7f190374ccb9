#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hair/groom/groom.h"
#include "hair/groom/strand_format.h"

// The thesis's guide file. Little-endian, nothing between the parts:
//   int32 strands, int32 segments, int32 triangles
//   float32 points[strands][segments + 1][3]    m, root first
//   int32 root_triangles[triangles][3]          guide indices
namespace hair::groom {

// Writes points and root triangles; the format has no place for anything else. Strands with
// differing numbers of points, or with fewer than 2 or more than 256, are resampled. Returns a
// warning for all data that is changed or left out. Throws engine::Error if there are no strands,
// or too many of them.
std::vector<std::string> exportHgl(const StrandSet& strands, std::ostream& out);

// Refuses files that are not exactly of the format: no strands, segments outside [1, 255], a size
// that doesn't match the counts (checked before any allocation), a point that is not finite, a
// triangle of a guide that isn't there. A triangle may name a guide twice: hair between two
// guides. Throws the first of the file's errors as engine::Error "byte N: reason".
StrandSet importHgl(const StrandFile& file);

}  // namespace hair::groom
