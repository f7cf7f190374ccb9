#pragma once

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "hair/groom/groom.h"
#include "hair/groom/strand_format.h"

// Three formats of research on hair, which have counts and points but no header. They are
// little-endian and state no unit. Two list strand after strand:
//   int32 strands
//   for each strand: int32 points, then its points
// .data has points of float32[3]: USC-HairSalon (Hu et al. 2015, Single-view hair modeling using a
// hairstyle database), the Hair Photobooth (Paris et al. 2008) and models trained with them.
// .bin has points of float32[7]: position, tangent or colour, and a label that is always 0; CT2Hair
// (Shen et al. 2023, CT2Hair: high-fidelity 3D hair modeling using computed tomography).
// The third has the extension of Cem Yuksel's HAIR. MonoHair writes it (Wu et al. 2024, MonoHair:
// high-fidelity hair modeling from a monocular video):
//   uint32 strands, uint32 points of all strands
//   uint16 points[strands]     of each strand, not its segments
//   float32 points[points][3]
namespace hair::groom {

// Returns a warning for all data that is left out. Throws engine::Error if there are no strands or
// more of them than an int32 can hold.
std::vector<std::string> exportHairData(const StrandSet& strands, std::ostream& out);

// Strands without points are left out with a warning. Refuses files that are not exactly of the
// format: no strands with points, negative counts, counts that the file is too short for (checked
// before any allocation), trailing bytes, numbers that are not finite. Throws engine::Error "byte
// N: reason".
StrandSet importHairData(const StrandFile& file);

// Like CT2Hair's own reader, it leaves out strands with a position that is not a number and those
// of fewer than 5 points, with warnings; infinite positions are refused. Only the position of a
// point is read, because the file doesn't say whether a tangent or a colour follows it.
StrandSet importCt2Hair(const StrandFile& file);

// Whether a file that doesn't begin with "HAIR" can have as many strands as its first number says.
bool looksLikeCountedHair(std::span<const std::byte> head, std::uint64_t size);

// The sizes of the strands count; MonoHair's reader ignores the number of all points, so another
// one is only a warning. Refuses files that are longer or shorter than the sizes say (checked
// before the points are allocated) and files without a strand. Throws engine::Error "byte N:
// reason".
StrandSet importCountedHair(const StrandFile& file);

}  // namespace hair::groom
