#include "hair/groom/guides/root_tree.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace hair {
namespace {

struct Range {
    std::size_t first, count;

    std::size_t middle() const { return first + count / 2; }
    Range before() const { return {first, count / 2}; }
    Range after() const { return {middle() + 1, count - count / 2 - 1}; }
};

}  // namespace

RootTree::RootTree(std::span<const glm::vec3> points) {
    nodes_.reserve(points.size());
    for (const glm::vec3& point : points)
        nodes_.push_back({point, static_cast<std::uint32_t>(nodes_.size()), 0});
    std::vector<Range> open{{0, nodes_.size()}};
    while (!open.empty()) {
        const Range range = open.back();
        open.pop_back();
        if (range.count == 0) continue;
        const auto members = std::span(nodes_).subspan(range.first, range.count);
        glm::vec3 low = members.front().point;
        glm::vec3 high = low;
        for (const Node& node : members) {
            low = glm::min(low, node.point);
            high = glm::max(high, node.point);
        }
        const glm::vec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        std::ranges::nth_element(
            members, members.begin() + static_cast<std::ptrdiff_t>(range.count / 2), {},
            [axis](const Node& node) { return std::pair(node.point[axis], node.source); });
        nodes_[range.middle()].axis = axis;
        open.push_back(range.before());
        open.push_back(range.after());
    }
}

std::size_t RootTree::find(const glm::vec3& place, std::span<std::uint32_t> nearest) const {
    struct Found {
        double square;
        std::uint32_t source;
        auto operator<=>(const Found&) const = default;
    };
    static constexpr std::size_t most = 16;
    assert(!nearest.empty() && nearest.size() <= most);
    std::array<Found, most> found;  // ascending
    std::size_t count = 0;
    const auto offer = [&](const Node& node) {
        const glm::dvec3 apart = glm::dvec3(node.point) - glm::dvec3(place);
        const Found one{glm::dot(apart, apart), node.source};
        if (count == nearest.size() && one >= found[count - 1]) return;
        if (count < nearest.size()) ++count;
        std::size_t slot = count - 1;
        for (; slot > 0 && one < found[slot - 1]; --slot) found[slot] = found[slot - 1];
        found[slot] = one;
    };

    struct Waiting {
        Range range;
        double least;  // no point in the range is nearer, squared
    };
    std::array<Waiting, 64> waiting;  // one for each level: every split halves
    std::size_t open = 0;
    waiting[open++] = {{0, nodes_.size()}, 0.0};
    while (open > 0) {
        auto [range, least] = waiting[--open];
        while (range.count > 0 && (count < nearest.size() || least <= found[count - 1].square)) {
            const Node& node = nodes_[range.middle()];
            offer(node);
            const double across = double{place[node.axis]} - double{node.point[node.axis]};
            const Range far = across < 0.0 ? range.after() : range.before();
            waiting[open++] = {far, std::max(least, across * across)};
            range = across < 0.0 ? range.before() : range.after();
        }
    }
    for (std::size_t i = 0; i < count; ++i) nearest[i] = found[i].source;
    return count;
}

}  // namespace hair
