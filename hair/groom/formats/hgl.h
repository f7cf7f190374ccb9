#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hair/groom/files.h"
#include "hair/groom/groom.h"

// The thesis's guide file. Little-endian, nothing between the parts:
//   int32 strands, int32 segments, int32 triangles
//   float32 points[strands][segments + 1][3]    m, root first
//   int32 root_triangles[triangles][3]          guide indices
namespace hair::groom {

// Writes points and root triangles, which is all that the format has a place for. Strands of
// differing numbers of points, or of others than 2 to 256, are resampled. Returns what is not
// written as it is. Throws engine::Error where there are no strands, or too many of them.
std::vector<std::string> exportHgl(const StrandSet& strands, std::ostream& out);

// Refuses whatever is not exactly such a file: no strands, segments outside [1, 255], a size that
// the counts don't give (looked at before anything is allocated), a point that is not finite, a
// triangle that names a guide that isn't there. A triangle may name a guide twice: hair between two
// guides. The first of the file's errors is thrown as engine::Error "byte N: reason".
StrandSet importHgl(const StrandFile& file);

}  // namespace hair::groom
