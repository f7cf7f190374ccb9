#pragma once

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "hair/groom/groom.h"
#include "hair/groom/strand_format.h"

// Files of hair of the Mitsuba renderer, in two forms without a unit:
//   binary  of its plug-in `hair` (versions 0.5 and 0.6), little-endian: "BINARY_HAIR", uint32
//           vertices of all strands, then float32 x, y, z of each vertex. An infinite number before
//           a vertex begins a strand
//   text    a line "x y z" or "x y z radius" for each vertex. An empty line, or one that begins
//           with '#', is between strands. Three numbers are those of `hair`; four are those of
//           Mitsuba 3's `linearcurve` and `bsplinecurve`
// The text doesn't say which of the two curves it is for, so strands are the polylines of its
// vertices.
namespace hair::groom {

// Writes the binary form, without widths. Returns a warning for all data that is left out. Throws
// engine::Error if there are no strands.
std::vector<std::string> exportMitsubaBinary(const StrandSet& strands, std::ostream& out);

// Writes the text: with radii, which are half the widths, if widths are known. Numbers are the
// shortest decimals that give the same floats. Returns and throws as above.
std::vector<std::string> exportMitsubaText(const StrandSet& strands, std::ostream& out);

// Whether the first bytes are digits, as in a file in text.
bool looksLikeMitsubaText(std::span<const std::byte> head, std::uint64_t size);

// Reads both forms; widths are twice the radii. Refuses other files: a number of vertices that
// doesn't match the file's size (checked before any allocation), words that are not numbers, lines
// with more or fewer numbers than the first. Throws engine::Error "byte N: reason"
// or "line N: reason".
StrandSet importMitsubaHair(const StrandFile& file);

}  // namespace hair::groom
