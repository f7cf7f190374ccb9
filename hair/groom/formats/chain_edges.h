#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "hair/groom/formats/polylines.h"

namespace hair {

using Edge = std::array<std::uint32_t, 2>;  // vertices, in either order

// Edges that share vertices as strands, in the order in which the edges first use them. A strand's
// root is the end that comes first among the vertices. Throws engine::Error "place: reason" for a
// vertex that isn't there, one that more than two edges share, and a closed loop; `place` says
// where in the file an edge is.
Polylines chainEdges(
    std::span<const Edge> edges, std::size_t vertex_count,
    const std::function<std::string(std::size_t edge)>& place);

// The edges that chainEdges() makes the same strands of, and a warning where a strand is of a
// single point, which has none. Throws engine::Error where no strand has an edge.
std::vector<Edge> edgesOf(const StrandSet& strands, std::vector<std::string>& warnings);

}  // namespace hair
