#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hair/groom/files.h"
#include "hair/groom/groom.h"

// NumPy's arrays (numpy.lib.format, versions 1.0 to 3.0), which have no unit:
//   .npy  one array of shape (strands, points of each, 3)
//   .npz  a zip archive of arrays by name, stored or deflated (PKWARE, APPNOTE 6.3.10; no ZIP64, no
//         encryption). Its arrays are those of DiffLocks (Rosu et al. 2025),
//           positions (strands, points, 3), root_uv (strands, 2)
//         and, of hairbench,
//           widths (strands, points), groups (strands), guides (strands), 0 or 1
//         Without `positions` the one array that has its shape is read.
// Numbers are little-endian: float32 or float64, groups int32 or int64, guides uint8 or bool.
// Arrays are in C's order or in Fortran's.
namespace hair::groom {

// Strands of differing numbers of points are resampled to the greatest of them, which a warning
// says. Numbers are float32, int32 and uint8, in C's order; nothing is deflated. Return what is
// left out. Throw engine::Error where there are no strands, or an array has 4 GiB or more.
std::vector<std::string> exportNpy(const StrandSet& strands, std::ostream& out);
std::vector<std::string> exportNpz(const StrandSet& strands, std::ostream& out);

// Arrays of other names are left out with a warning, and DiffLocks' root_normal is among them.
// Refuse whatever is not exactly such a file: other types and shapes, an array that isn't as long
// as its header says (looked at before anything is allocated), a wrong checksum, numbers that are
// not finite, negative widths. Throw engine::Error "byte N: reason".
StrandSet importNpy(const StrandFile& file);
StrandSet importNpz(const StrandFile& file);

}  // namespace hair::groom
