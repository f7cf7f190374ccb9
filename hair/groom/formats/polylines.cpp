#include "hair/groom/formats/polylines.h"

#include <algorithm>
#include <limits>
#include <string>

namespace hair {
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

}  // namespace

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

}  // namespace hair
