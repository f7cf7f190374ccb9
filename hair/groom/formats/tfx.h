#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hair/groom/groom.h"
#include "hair/groom/strand_format.h"

// TressFX 4 (AMD, TressFXFileFormat.h), guide strands. Little-endian: a header of 160 bytes, which
// says where these arrays lie:
//   float32 positions[strands][vertices_per_strand][4]    xyz and inverse mass, 0 if fixed
//   float32 strand_uvs[strands][2]
//   float32 vertex_uvs[strands][vertices_per_strand][2]
//   float32 strand_thickness[strands]                     diameters
//   float32 vertex_colors[strands][vertices_per_strand][4]    RGB and alpha
// All except the positions may be absent. The format states no unit.
// Version 3 (TressFXFileFormat.h of TressFX 3.1) has a header of 296 bytes, positions of three
// floats and one more array, with each strand's guide. Version 2 is text:
//   version 2.0
//   scale 1.0, rotation 0 0 0, translation 0 0 0, bothEndsImmovable 0, maxNumVerticesInStrand 16,
//   numFollowHairsPerGuideHair 4, maxRadiusAroundGuideHair 0.5, numStrands 1, is sorted 1: a line
//   each strand 0 numVerts 16 texcoord 0.5 0.5, then its points, a line each
namespace hair::groom {

// Writes the arrays at multiples of 8 bytes. Each strand has one width, that of its root. Its
// first two vertices are fixed, as by AMD's exporters. Strands with differing numbers of points
// are resampled to a number that TressFX takes: 4, 8, 16, 32 or 64. Returns a warning for all data
// that is changed or left out. Throws engine::Error if there are no strands, or more bytes than
// 32-bit offsets reach.
std::vector<std::string> exportTfx(const StrandSet& strands, std::ostream& out);

// Transparency is 1 - alpha. Inverse masses are left to TressFX; a warning reports fixed vertices
// beyond the first two, which TressFX always fixes, and texture coordinates of vertices. From
// earlier versions, which let TressFX make followers on loading, the strands of the file are read,
// and a warning reports the number of followers of each. Text with a transform is refused, because
// nothing states how it is applied. Refuses other versions, no strands, strands of less than 2
// vertices, arrays that overlap, lie outside the file (checked before any allocation) or not at a
// multiple of 4 bytes, numbers that are not finite. Throws engine::Error
// "byte N: reason", or "line N: reason".
StrandSet importTfx(const StrandFile& file);

}  // namespace hair::groom
