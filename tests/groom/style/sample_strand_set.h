#pragma once

#include "hair/groom/groom.h"

namespace hair::groom {

// Three strands of two, three and one points, with some data of every kind.
inline StrandSet sampleStrandSet() {
    StrandSet strands;
    strands.ends = {2, 5, 6};
    strands.points = {{0, 0, 0}, {0, 1, 0}, {2, 0, 0}, {2, 0, 2}, {2, 0, 3}, {5, 5, 5}};
    strands.widths.values = {1, 2, 3, 4, 5, 6};
    strands.transparencies.everywhere = 0.25f;
    for (const float gray : {0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f})
        strands.colors.values.emplace_back(gray);
    strands.root_uvs = {{0.1f, 1}, {0.2f, 2}, {0.3f, 3}};
    strands.groups = {4, -5, 6};
    strands.guides = {1, 0, 1};
    strands.root_triangles = {{0, 1, 2}};
    strands.metres_per_unit = 0.01;
    strands.comment = "sample";
    strands.warnings = {"odd"};
    return strands;
}

}  // namespace hair::groom
