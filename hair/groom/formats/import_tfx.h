#pragma once

#include "hair/groom/importers.h"

// TressFX 4 (AMD, TressFXFileFormat.h), guide strands. Little-endian; tfx_header.h has the header,
// which says where the arrays lie:
//   float32 positions[strands][vertices_per_strand][4]    xyz and inverse mass, 0 where fixed
//   float32 strand_uvs[strands][2]
//   float32 vertex_uvs[strands][vertices_per_strand][2]
//   float32 strand_thickness[strands]                     diameters
//   float32 vertex_colors[strands][vertices_per_strand][4]    RGB and alpha
// All but the positions may be absent. The format states no unit.
namespace hair {

// Transparency is 1 - alpha. Inverse masses are TressFX's own matter; a warning tells of vertices
// that are fixed beyond the first two, which it fixes always, and of texture coordinates of
// vertices. Refuses another version than 4.0, no strands, strands of less than 2 vertices, arrays
// that overlap, lie outside the file (looked at before anything is allocated) or not at a multiple
// of 4 bytes, numbers that are not finite and negative thickness.
// Throws engine::Error "byte N: reason".
StrandSet importTfx(const StrandFile& file);

}  // namespace hair
