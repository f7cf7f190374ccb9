#include "hair/groom/formats/polylines.h"

#include <algorithm>
#include <limits>

#include "engine/error.h"

namespace hair::groom {
namespace {

std::size_t countUnused(const Polylines& lines, std::size_t vertex_count) {
    std::vector<bool> used(vertex_count);
    for (const std::uint32_t vertex : lines.vertices) used[vertex] = true;
    return static_cast<std::size_t>(std::ranges::count(used, false));
}

bool inOrder(const std::vector<std::uint32_t>& vertices) {
    for (std::size_t i = 0; i < vertices.size(); ++i)
        if (vertices[i] != i) return false;
    return true;
}

template <class Value>
void gather(std::vector<Value>& values, const std::vector<std::uint32_t>& vertices) {
    if (values.empty()) return;
    std::vector<Value> gathered(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) gathered[i] = values[vertices[i]];
    values = std::move(gathered);
}

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

std::string vertexName(std::uint32_t vertex) { return "vertex " + std::to_string(vertex); }

// The vertices that edges join to each vertex.
class Neighbours {
public:
    explicit Neighbours(std::size_t vertex_count) : of_(vertex_count, {kNone, kNone}) {}

    // False if the vertex has two already.
    bool add(std::uint32_t vertex, std::uint32_t neighbour) {
        for (std::uint32_t& slot : of_[vertex]) {
            if (slot != kNone) continue;
            slot = neighbour;
            return true;
        }
        return false;
    }

    // Returns the vertex after `from`, coming from `before`; kNone at an end.
    std::uint32_t next(std::uint32_t before, std::uint32_t from) const {
        const Edge& pair = of_[from];
        return pair[0] == before ? pair[1] : pair[0];
    }

    // Returns the last vertex of the chain that runs from `first` over `second`; kNone in a closed
    // loop.
    std::uint32_t lastOf(std::uint32_t first, std::uint32_t second) const {
        std::uint32_t before = first;
        std::uint32_t at = second;
        for (;;) {
            const std::uint32_t after = next(before, at);
            if (after == kNone) return at;
            if (at == first) return kNone;
            before = at;
            at = after;
        }
    }

private:
    std::vector<Edge> of_;
};

Neighbours join(
    std::span<const Edge> edges, std::size_t vertex_count,
    const std::function<std::string(std::size_t)>& place) {
    Neighbours neighbours(vertex_count);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const auto [a, b] = edges[i];
        for (const std::uint32_t vertex : {a, b}) {
            if (vertex < vertex_count) continue;
            throw engine::Error(
                place(i), "the edge names " + vertexName(vertex) + ", but there are " +
                              std::to_string(vertex_count));
        }
        if (a == b) throw engine::Error(place(i), "the edge joins " + vertexName(a) + " to itself");
        for (const auto& [vertex, neighbour] : {Edge{a, b}, Edge{b, a}}) {
            if (neighbours.add(vertex, neighbour)) continue;
            throw engine::Error(
                place(i), "this is a third edge at " + vertexName(vertex) +
                              ": strands don't branch, so at most two are expected");
        }
    }
    return neighbours;
}

}  // namespace

// ---- Polylines ----------------------------------------------------------------------------------

bool hasRoomFor(const Polylines& lines, std::size_t size) {
    return size <= std::numeric_limits<std::uint32_t>::max() - lines.vertices.size();
}

void arrangePoints(StrandSet& set, Polylines lines) {
    const std::size_t vertex_count = set.points.size();
    set.ends = std::move(lines.ends);
    if (lines.vertices.size() == vertex_count && inOrder(lines.vertices)) return;
    if (const std::size_t unused = countUnused(lines, vertex_count); unused > 0) {
        set.warnings.push_back(
            std::to_string(unused) + " of " + std::to_string(vertex_count) +
            " points belong to no strand and are left out");
    }
    gather(set.points, lines.vertices);
    gather(set.widths.values, lines.vertices);
    gather(set.transparencies.values, lines.vertices);
    gather(set.colors.values, lines.vertices);
}

// ---- Chains of edges ----------------------------------------------------------------------------

Polylines chainEdges(
    std::span<const Edge> edges, std::size_t vertex_count,
    const std::function<std::string(std::size_t edge)>& place) {
    const Neighbours neighbours = join(edges, vertex_count, place);
    Polylines lines;
    lines.vertices.reserve(vertex_count);
    std::vector<bool> done(vertex_count);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const auto [a, b] = edges[i];
        if (done[a]) continue;
        const std::uint32_t one_end = neighbours.lastOf(a, b);
        if (one_end == kNone) {
            throw engine::Error(
                place(i), "the edge belongs to a closed loop, but a strand has two ends");
        }
        const std::uint32_t other_end = neighbours.lastOf(b, a);
        std::uint32_t before = kNone;
        std::uint32_t at = std::min(one_end, other_end);
        while (at != kNone) {
            done[at] = true;
            lines.vertices.push_back(at);
            const std::uint32_t after = neighbours.next(before, at);
            before = at;
            at = after;
        }
        lines.ends.push_back(static_cast<std::uint32_t>(lines.vertices.size()));
    }
    return lines;
}

std::vector<Edge> edgesOf(const StrandSet& strands, std::vector<std::string>& warnings) {
    std::vector<Edge> edges;
    edges.reserve(strands.points.size() - strands.ends.size());
    std::uint32_t first = 0;
    std::size_t single = 0;
    for (const std::uint32_t end : strands.ends) {
        for (std::uint32_t i = first; i + 1 < end; ++i) edges.push_back({i, i + 1});
        if (end - first == 1) ++single;
        first = end;
    }
    if (edges.empty()) throw engine::Error("no strand has the two points that a line needs");
    if (single > 0) {
        warnings.push_back(
            std::to_string(single) +
            " strands of a single point are written as points, not as lines");
    }
    return edges;
}

}  // namespace hair::groom
