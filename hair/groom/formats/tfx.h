#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hair/groom/files.h"
#include "hair/groom/groom.h"

// TressFX 4 (AMD, TressFXFileFormat.h), guide strands. Little-endian: a header of 160 bytes, which
// says where these arrays lie:
//   float32 positions[strands][vertices_per_strand][4]    xyz and inverse mass, 0 where fixed
//   float32 strand_uvs[strands][2]
//   float32 vertex_uvs[strands][vertices_per_strand][2]
//   float32 strand_thickness[strands]                     diameters
//   float32 vertex_colors[strands][vertices_per_strand][4]    RGB and alpha
// All but the positions may be absent. The format states no unit.
// Version 3 (TressFXFileFormat.h of TressFX 3.1) has a header of 296 bytes, positions of three
// floats and, with each strand's guide, one array more. Version 2 is text:
//   version 2.0
//   scale 1.0, rotation 0 0 0, translation 0 0 0, bothEndsImmovable 0, maxNumVerticesInStrand 16,
//   numFollowHairsPerGuideHair 4, maxRadiusAroundGuideHair 0.5, numStrands 1, is sorted 1: a line
//   each strand 0 numVerts 16 texcoord 0.5 0.5, then its points, a line each
namespace hair::groom {

// Writes the arrays at multiples of 8 bytes. Each strand has one width, that of its root; its first
// two vertices are fixed, as AMD's exporters do it. Strands of differing numbers of points are
// resampled to a number that TressFX takes: 4, 8, 16, 32 or 64. Returns what is not written as it
// is. Throws engine::Error where there are no strands, or more bytes than 32-bit offsets reach.
std::vector<std::string> exportTfx(const StrandSet& strands, std::ostream& out);

// Transparency is 1 - alpha. Inverse masses are TressFX's own matter; a warning tells of vertices
// that are fixed beyond the first two, which it fixes always, and of texture coordinates of
// vertices. Of the versions before, whose followers TressFX makes when it loads them, the strands
// of the file are read, and a warning tells how many followers each would get. Text is refused with
// a transform, for nothing states how it is applied. Refuses other versions, no strands, strands of
// less than 2 vertices, arrays that overlap, lie outside the file (looked at before anything is
// allocated) or not at a multiple of 4 bytes, numbers that are not finite and negative thickness.
// Throws engine::Error "byte N: reason", or "line N: reason".
StrandSet importTfx(const StrandFile& file);

}  // namespace hair::groom
