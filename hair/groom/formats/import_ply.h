#pragma once

#include "hair/groom/importers.h"

namespace hair {

// Strands of a PLY file (Greg Turk, The PLY Polygon File Format, 1994), ascii or binary of either
// byte order. The points are the element `vertex`: x, y, z, and as far as they are there width or
// radius, red, green, blue, and transparency or alpha. The strands are the first of
//   - the lists `vertex_indices` or `vertex_index` of an element `strand`, `polyline` or `line`,
//     root first,
//   - chains of the element `edge` (vertex1, vertex2), see chain_edges.h,
//   - the lists of two vertices of the element `face`, as which assimp writes lines: edges.
// Everything else is skipped with a warning.
StrandSet importPly(const StrandFile& file);

}  // namespace hair
