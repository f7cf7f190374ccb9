#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "hair/groom/groom.h"

// Strands as chains of numbered vertices, as in formats of meshes and lines.
namespace hair::groom {

// Strands as numbers of vertices.
struct Polylines {
    std::vector<std::uint32_t> ends;      // [strand], index after its last point
    std::vector<std::uint32_t> vertices;  // [point], strand after strand, root first
};

// Whether one more polyline of `size` points still has an end in 32 bits.
bool hasRoomFor(const Polylines& lines, std::size_t size);

// Makes strands of the vertices that `set` holds as points, with all of their attributes: `lines`
// become its strands. Vertices that no strand uses are left out with a warning. All vertices of
// `lines` must exist.
void arrangePoints(StrandSet& set, Polylines lines);

using Edge = std::array<std::uint32_t, 2>;  // vertices, in either order

// Chains edges that share vertices to strands, in the order in which the edges first use them. A
// strand's root is its end that comes first among the vertices. Throws engine::Error "place:
// reason" for a vertex that isn't there, a vertex of more than two edges, and a closed loop;
// `place` gives the place of an edge in the file.
Polylines chainEdges(
    std::span<const Edge> edges, std::size_t vertex_count,
    const std::function<std::string(std::size_t edge)>& place);

// Returns the edges from which chainEdges() makes the same strands, and warns of strands of a
// single point, which have no edge. Throws engine::Error if no strand has an edge.
std::vector<Edge> edgesOf(const StrandSet& strands, std::vector<std::string>& warnings);

}  // namespace hair::groom
