#pragma once

#include "hair/groom/formats/ply_values.h"
#include "hair/groom/strand_set.h"

namespace hair {

// The element `vertex`. Throws engine::Error "line N: reason" where it isn't there, has no
// coordinates, or more of them than 32 bits can number.
const PlyElement& plyVertices(const PlyHeader& header);

// Reads the element's points, widths, colours and transparencies as those of `set`, and warns of
// what else it has. The source expects the element. Throws engine::Error "place: reason".
template <class Source>
void readPlyVertices(Source& source, const PlyElement& element, StrandSet& set);

}  // namespace hair
