#include "hair/groom/mesh/nearest_surface.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace hair {
namespace {

constexpr std::size_t kMostInLeaf = 4;
constexpr std::size_t kMostLevels = 64;  // every split halves, and counts have 32 bits

using Corners = std::array<glm::vec3, 3>;

struct Box {
    glm::vec3 low{std::numeric_limits<float>::max()};
    glm::vec3 high{std::numeric_limits<float>::lowest()};

    void add(const glm::vec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }

    int longestAxis() const {
        const glm::vec3 size = high - low;
        return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    }
};

double square(const glm::dvec3& v) { return glm::dot(v, v); }

double squareDistance(const glm::dvec3& p, const glm::vec3& low, const glm::vec3& high) {
    return square(p - glm::clamp(p, glm::dvec3(low), glm::dvec3(high)));
}

struct Candidate {
    double square = std::numeric_limits<double>::max();  // of the distance
    glm::dvec3 weights{1.0, 0.0, 0.0};
    std::size_t slot = 0;  // of the triangle
};

// The point of a triangle that is nearest: over the face where the point lies within the three
// planes through the edges, else the nearest of the edges' (the regions of Ericson 2005, Real-time
// collision detection, 5.1.5). A triangle without area has only edges, one without length only
// corners.
void compare(const glm::dvec3& p, const Corners& corners, std::size_t slot, Candidate& best) {
    const std::array from{
        p - glm::dvec3(corners[0]), p - glm::dvec3(corners[1]), p - glm::dvec3(corners[2])};
    const std::array edges{from[0] - from[1], from[1] - from[2], from[2] - from[0]};
    const glm::dvec3 normal = glm::cross(edges[0], edges[1]);
    const double area = square(normal);  // 4 times its square
    if (area > 0.0) {
        const double height = glm::dot(from[0], normal);  // times the normal's length
        if (height * height >= best.square * area) return;
        const glm::dvec3 parts(
            glm::dot(normal, glm::cross(edges[1], from[1])),
            glm::dot(normal, glm::cross(edges[2], from[2])),
            glm::dot(normal, glm::cross(edges[0], from[0])));
        const double sum = parts.x + parts.y + parts.z;
        if (parts.x >= 0.0 && parts.y >= 0.0 && parts.z >= 0.0 && sum > 0.0) {
            best = {height * height / area, parts / sum, slot};
            return;
        }
    }
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const double size = square(edges[k]);
        const double along =
            size > 0.0 ? std::clamp(glm::dot(from[k], edges[k]) / size, 0.0, 1.0) : 0.0;
        const double found = square(from[k] - along * edges[k]);
        if (found >= best.square) continue;
        best = {found, glm::dvec3(0.0), slot};
        best.weights[i] = 1.0 - along;
        best.weights[(i + 1) % 3] = along;
    }
}

}  // namespace

NearestSurface::NearestSurface(
    std::span<const glm::vec3> positions, std::span<const std::array<std::uint32_t, 3>> triangles) {
    assert(!triangles.empty());
    std::vector<glm::vec3> centroids;
    centroids.reserve(triangles.size());
    for (const auto& [a, b, c] : triangles)
        centroids.push_back((positions[a] + positions[b] + positions[c]) / 3.0f);
    sources_.resize(triangles.size());
    std::iota(sources_.begin(), sources_.end(), 0u);

    struct Open {
        std::size_t node, first, count;
    };
    std::vector<Open> open{{0, 0, triangles.size()}};
    nodes_.resize(1);
    while (!open.empty()) {
        const auto [node, first, count] = open.back();
        open.pop_back();
        const auto members = std::span(sources_).subspan(first, count);
        Box box;
        Box middle;
        for (const std::uint32_t triangle : members) {
            for (const std::uint32_t corner : triangles[triangle]) box.add(positions[corner]);
            middle.add(centroids[triangle]);
        }
        nodes_[node] = {
            box.low, box.high, static_cast<std::uint32_t>(first),
            static_cast<std::uint32_t>(count)};
        if (count <= kMostInLeaf) continue;

        // Equal centroids go by number, so that the tree is the same everywhere.
        const int axis = middle.longestAxis();
        const std::size_t half = count / 2;
        std::ranges::nth_element(
            members, members.begin() + static_cast<std::ptrdiff_t>(half),
            [&](std::uint32_t a, std::uint32_t b) {
                return std::pair(centroids[a][axis], a) < std::pair(centroids[b][axis], b);
            });
        const std::size_t child = nodes_.size();
        nodes_[node].first = static_cast<std::uint32_t>(child);
        nodes_[node].count = 0;
        nodes_.resize(child + 2);
        open.push_back({child, first, half});
        open.push_back({child + 1, first + half, count - half});
    }
    corners_.reserve(triangles.size());
    for (const std::uint32_t triangle : sources_) {
        const auto& [a, b, c] = triangles[triangle];
        corners_.push_back({positions[a], positions[b], positions[c]});
    }
}

MeshPoint NearestSurface::operator()(const glm::dvec3& point) const {
    struct Waiting {
        std::uint32_t node;
        double square;  // of its box's distance
    };
    std::array<Waiting, kMostLevels> waiting;
    std::size_t count = 0;
    const auto wait = [&](std::uint32_t node) {
        waiting[count++] = {node, squareDistance(point, nodes_[node].low, nodes_[node].high)};
    };
    Candidate best;
    wait(0);
    while (count > 0) {
        const Waiting next = waiting[--count];
        if (next.square >= best.square) continue;
        const Node& node = nodes_[next.node];
        for (std::size_t i = 0; i < node.count; ++i)
            compare(point, corners_[node.first + i], node.first + i, best);
        if (node.count > 0) continue;
        wait(node.first);
        wait(node.first + 1);
        if (waiting[count - 2].square < waiting[count - 1].square)
            std::swap(waiting[count - 2], waiting[count - 1]);
    }

    const Corners& corners = corners_[best.slot];
    MeshPoint found{.triangle = sources_[best.slot], .weights = best.weights};
    for (int i = 0; i < 3; ++i)
        found.position += best.weights[i] * glm::dvec3(corners[static_cast<std::size_t>(i)]);
    found.distance = glm::distance(found.position, point);
    return found;
}

}  // namespace hair
