#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "hair/groom/groom.h"

// Strands as chains of numbered vertices: what formats of meshes and lines have.
namespace hair::groom {

// Strands as numbers of vertices.
struct Polylines {
    std::vector<std::uint32_t> ends;      // [strand], index after its last point
    std::vector<std::uint32_t> vertices;  // [point], strand after strand, root first
};

// Whether one more polyline of `size` points still has an end in 32 bits.
bool hasRoomFor(const Polylines& lines, std::size_t size);

// Strands of the vertices that `set` holds as points, with all that it holds for each: they become
// the points of `lines`, and vertices that no strand uses are left out with a warning. Every
// vertex of `lines` is there.
void arrangePoints(StrandSet& set, Polylines lines);

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

}  // namespace hair::groom
