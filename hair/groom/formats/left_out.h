#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "hair/groom/strand_set.h"

namespace hair {

// What strands may have beside their points.
enum class Part { widths, transparencies, colors, root_uvs, root_triangles, unit, comment };

// A sentence for each part that the strands have and the format has no place for. To be opaque
// everywhere is not to have transparencies.
std::vector<std::string> leftOut(const StrandSet& strands, std::initializer_list<Part> held);

}  // namespace hair
