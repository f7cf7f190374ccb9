#pragma once

#include <cstdint>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "hair/groom/groom.h"
#include "hair/groom/strand_format.h"

// NumPy's arrays (numpy.lib.format, versions 1.0 to 3.0), which have no unit:
//   .npy  one array of shape (strands, points of each, 3)
//   .npz  a zip archive of arrays by name, stored or deflated (PKWARE, APPNOTE 6.3.10; no ZIP64, no
//         encryption). Its arrays are those of DiffLocks (Rosu et al. 2025),
//           positions (strands, points, 3), root_uv (strands, 2)
//         and, of hairbench,
//           widths (strands, points), groups (strands), guides (strands), 0 or 1
//         Without `positions`, the only array of its shape is read.
// Numbers are little-endian: float32 or float64, groups int32 or int64, guides uint8 or bool.
// Arrays are in C's order or in Fortran's.
namespace hair::groom {

// Returns the beginning of a .npy file of float32 numbers in C's order, which follow. It has a
// multiple of 64 bytes, so that the numbers can be mapped.
std::string npyHeader(std::span<const std::uint64_t> shape);

// Strands with differing numbers of points are resampled to the greatest of them, with a warning.
// Numbers are float32, int32 and uint8, in C's order; nothing is deflated. Both return what is
// left out. Both throw engine::Error if there are no strands, or an array has 4 GiB or more.
std::vector<std::string> exportNpy(const StrandSet& strands, std::ostream& out);
std::vector<std::string> exportNpz(const StrandSet& strands, std::ostream& out);

// Arrays of other names, such as DiffLocks' root_normal, are left out with a warning. Both refuse
// files that are not exactly of the format: other types and shapes, arrays not as long as their
// header says (checked before any allocation), wrong checksums. Both throw engine::Error "byte N:
// reason".
StrandSet importNpy(const StrandFile& file);
StrandSet importNpz(const StrandFile& file);

}  // namespace hair::groom
