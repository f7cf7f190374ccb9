#include "hair/groom/mesh/surface.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <limits>
#include <numeric>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "engine/error.h"

namespace hair::groom {
namespace {

// ---- Triangle sides -----------------------------------------------------------------------------

using Triangle = std::array<std::uint32_t, 3>;

// One side of a triangle: from this corner to the next.
struct Side {
    std::uint32_t triangle;
    std::uint32_t corner;
};

struct EdgeSide {
    std::uint32_t low, high;  // the vertices of the edge
    Side side;
    bool upward;  // runs from low to high
};

std::vector<EdgeSide> sortedSides(std::span<const Triangle> triangles) {
    std::vector<EdgeSide> sides;
    sides.reserve(3 * triangles.size());
    for (std::uint32_t triangle = 0; triangle < triangles.size(); ++triangle) {
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t from = triangles[triangle][corner];
            const std::uint32_t to = triangles[triangle][(corner + 1) % 3];
            sides.push_back(
                {std::min(from, to), std::max(from, to), {triangle, corner}, from < to});
        }
    }
    std::ranges::sort(sides, {}, [](const EdgeSide& s) {
        return std::tuple(s.low, s.high, s.side.triangle, s.side.corner);
    });
    return sides;
}

// The edges with one kind of fault.
struct Fault {
    const char* what;
    std::size_t edges = 0;
    std::pair<std::uint32_t, std::uint32_t> first{};

    void add(const EdgeSide& side) {
        if (edges++ == 0) first = {side.low, side.high};
    }
};

std::string describe(std::span<const Fault> faults, std::span<const glm::vec3> positions) {
    std::ostringstream text;
    text << std::setprecision(9);
    const auto write = [&](const glm::vec3& p) {
        text << "(" << p.x << ", " << p.y << ", " << p.z << ")";
    };
    for (const Fault& fault : faults) {
        if (fault.edges == 0) continue;
        text << (text.tellp() > 0 ? "; " : "") << fault.what << ": " << fault.edges
             << ", the first from ";
        write(positions[fault.first.first]);
        text << " to ";
        write(positions[fault.first.second]);
    }
    return text.str();
}

// Edges by how triangles share them.
struct SharedEdges {
    std::vector<std::array<Side, 2>> pairs;  // sides that run along an edge in opposite directions
    Fault boundary{"edges with one triangle"};
    Fault opposed{"edges whose two triangles face opposite ways"};
    Fault branching{"edges with more than two triangles"};
    std::string faults;  // in words; empty: none

    SharedEdges(std::span<const Triangle> triangles, std::span<const glm::vec3> positions) {
        const std::vector<EdgeSide> sides = sortedSides(triangles);
        pairs.reserve(sides.size() / 2);
        for (std::size_t i = 0; i < sides.size();) {
            std::size_t end = i + 1;
            while (end < sides.size() && sides[end].low == sides[i].low &&
                   sides[end].high == sides[i].high)
                ++end;
            if (end - i == 1) {
                boundary.add(sides[i]);
            } else if (end - i > 2) {
                branching.add(sides[i]);
            } else if (sides[i].upward == sides[i + 1].upward) {
                opposed.add(sides[i]);
            } else {
                pairs.push_back({sides[i].side, sides[i + 1].side});
            }
            i = end;
        }
        faults = describe(std::array{boundary, opposed, branching}, positions);
    }
};

double
sideLength(const Triangle& triangle, std::uint32_t corner, std::span<const glm::vec3> positions) {
    return glm::distance(
        glm::dvec3(positions[triangle[corner]]), glm::dvec3(positions[triangle[(corner + 1) % 3]]));
}

bool isFlat(const Triangle& triangle, std::span<const glm::vec3> positions) {
    const glm::dvec3 a(positions[triangle[0]]);
    return glm::cross(
               glm::dvec3(positions[triangle[1]]) - a, glm::dvec3(positions[triangle[2]]) - a) ==
           glm::dvec3(0.0);
}

bool isLongest(
    const Triangle& triangle, std::uint32_t corner, std::span<const glm::vec3> positions) {
    const double length = sideLength(triangle, corner, positions);
    return length > sideLength(triangle, (corner + 1) % 3, positions) &&
           length > sideLength(triangle, (corner + 2) % 3, positions);
}

// The edge a-b between triangles (a, b, c) and (b, a, d) becomes c-d.
void turnEdge(
    Triangle& one, std::uint32_t corner_one, Triangle& other, std::uint32_t corner_other) {
    const std::uint32_t a = one[corner_one];
    const std::uint32_t b = other[corner_other];
    const std::uint32_t c = one[(corner_one + 2) % 3];
    const std::uint32_t d = other[(corner_other + 2) % 3];
    one = {b, c, d};
    other = {c, a, d};
}

// Returns the two sides that run along each edge in opposite directions. Throws engine::Error with
// the number of edges that are shared otherwise and the place of the first of them.
std::vector<std::array<Side, 2>>
pairSides(std::span<const Triangle> triangles, std::span<const glm::vec3> positions) {
    SharedEdges edges(triangles, positions);
    if (!edges.faults.empty()) throw engine::Error("the surface is not closed", edges.faults);
    return std::move(edges.pairs);
}

// Leaves out triangles with equal corners, and flips the longest edge of triangles with corners on
// a line. The surface stays the same and closed, and every triangle gets a normal. Throws as
// pairSides does, and if flat triangles are left.
// Every round flips at least one edge. If the triangle behind the longest side of a flat triangle
// is flat, too, its own longest side is at least as long. So following these sides ends at an edge
// that can be flipped. A flip leaves fewer flat triangles, or flat ones with a shorter edge, so the
// rounds end. The exception is coordinates so different that differences of their products are
// inexact.
void removeFlatTriangles(std::vector<Triangle>& triangles, std::span<const glm::vec3> positions) {
    for (std::size_t rounds = triangles.size() + 1; rounds > 0; --rounds) {
        std::erase_if(triangles, [](const Triangle& t) {
            return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
        });
        std::vector<bool> flat;
        for (const Triangle& triangle : triangles) flat.push_back(isFlat(triangle, positions));
        if (std::ranges::find(flat, true) == flat.end()) return;

        std::vector<bool> turned(triangles.size());
        bool any = false;
        for (const auto& [one, other] : pairSides(triangles, positions)) {
            Triangle& first = triangles[one.triangle];
            Triangle& second = triangles[other.triangle];
            const bool first_flat = flat[one.triangle];
            const bool second_flat = flat[other.triangle];
            if (turned[one.triangle] || turned[other.triangle] || !(first_flat || second_flat) ||
                (first_flat && !isLongest(first, one.corner, positions)) ||
                (second_flat && !isLongest(second, other.corner, positions)))
                continue;
            turnEdge(first, one.corner, second, other.corner);
            turned[one.triangle] = turned[other.triangle] = any = true;
        }
        if (!any) break;
    }
    throw engine::Error("the surface has triangles without area that can't be removed");
}

// ---- Welding ------------------------------------------------------------------------------------

struct PositionHash {
    std::size_t operator()(const std::array<float, 3>& p) const {
        std::uint64_t hash = 0;
        for (const float value : p) {
            hash = (hash ^ std::bit_cast<std::uint32_t>(value + 0.0f)) * 0x9e3779b97f4a7c15u;
            hash ^= hash >> 32;  // -0 equals 0 and has its hash
        }
        return hash;
    }
};

JoinedMesh weld(const Mesh& mesh) {
    JoinedMesh welded;
    std::unordered_map<std::array<float, 3>, std::uint32_t, PositionHash> vertices;
    vertices.reserve(mesh.positions.size());
    welded.triangles.reserve(mesh.triangles.size());
    for (const auto& triangle : mesh.triangles) {
        Triangle& joined = welded.triangles.emplace_back();
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::vec3& p = mesh.positions[triangle[i]];
            const auto [at, is_new] = vertices.try_emplace(
                {p.x, p.y, p.z}, static_cast<std::uint32_t>(welded.positions.size()));
            if (is_new) welded.positions.push_back(p);
            joined[i] = at->second;
        }
    }
    return welded;
}

// ---- Closed mesh --------------------------------------------------------------------------------

glm::dvec3 corner(const ClosedMesh& mesh, std::size_t triangle, std::size_t index) {
    return glm::dvec3(mesh.positions[mesh.triangles[triangle][index % 3]]);
}

void checkVolume(const ClosedMesh& mesh) {
    double volume = 0.0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        volume +=
            glm::dot(corner(mesh, i, 0), glm::cross(corner(mesh, i, 1), corner(mesh, i, 2)) / 6.0);
    if (volume > 0.0) return;
    std::ostringstream reason;
    reason << "it has " << mesh.triangles.size() << " triangles and a volume of " << volume
           << " m^3";
    throw engine::Error("the surface is inside out or encloses nothing", reason.str());
}

double angle(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

std::vector<Pseudonormals>
pseudonormals(const ClosedMesh& mesh, std::span<const std::array<Side, 2>> pairs) {
    std::vector<Pseudonormals> normals(mesh.triangles.size());
    std::vector<glm::dvec3> of_vertices(mesh.positions.size(), glm::dvec3(0.0));
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const glm::dvec3 a = corner(mesh, i, 0);
        normals[i].face =
            glm::normalize(glm::cross(corner(mesh, i, 1) - a, corner(mesh, i, 2) - a));
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 here = corner(mesh, i, k);
            of_vertices[mesh.triangles[i][k]] +=
                angle(corner(mesh, i, k + 1) - here, corner(mesh, i, k + 2) - here) *
                normals[i].face;
        }
    }
    for (const auto& [one, other] : pairs) {
        const glm::dvec3 sum = normals[one.triangle].face + normals[other.triangle].face;
        normals[one.triangle].edges[one.corner] = sum;
        normals[other.triangle].edges[other.corner] = sum;
    }
    for (std::size_t i = 0; i < normals.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k)
            normals[i].corners[k] = of_vertices[mesh.triangles[i][k]];
    }
    return normals;
}

}  // namespace

ClosedMesh closeMesh(const Mesh& mesh) {
    JoinedMesh welded = weld(mesh);
    ClosedMesh closed{
        .positions = std::move(welded.positions),
        .triangles = std::move(welded.triangles),
        .normals = {}};
    removeFlatTriangles(closed.triangles, closed.positions);
    const auto pairs = pairSides(closed.triangles, closed.positions);
    checkVolume(closed);
    closed.normals = pseudonormals(closed, pairs);
    return closed;
}

JoinedMesh joinMesh(const Mesh& mesh) {
    JoinedMesh joined = weld(mesh);
    std::set<Triangle> seen;
    std::erase_if(joined.triangles, [&](Triangle t) {
        if (isFlat(t, joined.positions)) return true;
        std::ranges::rotate(t, std::ranges::min_element(t));
        const bool is_new = seen.insert(t).second;
        joined.repeated += !is_new;
        return !is_new;
    });
    return joined;
}

MeshEdges meshEdges(const JoinedMesh& mesh) {
    SharedEdges shared(mesh.triangles, mesh.positions);
    MeshEdges edges{
        .boundary = shared.boundary.edges,
        .opposed = shared.opposed.edges,
        .branching = shared.branching.edges,
        .faults = std::move(shared.faults)};
    edges.pairs.reserve(shared.pairs.size());
    for (const auto& [one, other] : shared.pairs)
        edges.pairs.push_back({one.triangle, other.triangle});
    return edges;
}

namespace {

// ---- Triangle tree ------------------------------------------------------------------------------

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

}  // namespace

TriangleBvh buildTriangleBvh(
    std::span<const glm::vec3> positions, std::span<const std::array<std::uint32_t, 3>> triangles,
    std::size_t most_in_leaf) {
    assert(!triangles.empty() && most_in_leaf > 0);
    std::vector<glm::vec3> centroids;
    centroids.reserve(triangles.size());
    for (const auto& [a, b, c] : triangles)
        centroids.push_back((positions[a] + positions[b] + positions[c]) / 3.0f);
    TriangleBvh tree;
    tree.order.resize(triangles.size());
    std::iota(tree.order.begin(), tree.order.end(), 0u);

    struct Open {
        std::size_t node, first, count;
    };
    std::vector<Open> open{{0, 0, triangles.size()}};
    tree.nodes.resize(1);
    while (!open.empty()) {
        const auto [node, first, count] = open.back();
        open.pop_back();
        const auto members = std::span(tree.order).subspan(first, count);
        Box box;
        Box middle;
        for (const std::uint32_t triangle : members) {
            for (const std::uint32_t corner : triangles[triangle]) box.add(positions[corner]);
            middle.add(centroids[triangle]);
        }
        tree.nodes[node] = {
            box.low, box.high, static_cast<std::uint32_t>(first),
            static_cast<std::uint32_t>(count)};
        if (count <= most_in_leaf) continue;

        // Equal centroids are ordered by number, so that the tree is the same everywhere.
        const int axis = middle.longestAxis();
        const std::size_t half = count / 2;
        std::ranges::nth_element(
            members, members.begin() + static_cast<std::ptrdiff_t>(half),
            [&](std::uint32_t a, std::uint32_t b) {
                return std::pair(centroids[a][axis], a) < std::pair(centroids[b][axis], b);
            });
        const std::size_t child = tree.nodes.size();
        tree.nodes[node].first = static_cast<std::uint32_t>(child);
        tree.nodes[node].count = 0;
        tree.nodes.resize(child + 2);
        // The first half is split first: nodes are numbered depth first.
        open.push_back({child + 1, first + half, count - half});
        open.push_back({child, first, half});
    }
    return tree;
}

namespace {

// ---- Nearest surface ----------------------------------------------------------------------------

constexpr std::size_t kMostInLeaf = 4;

using CornerPoints = std::array<glm::vec3, 3>;

double square(const glm::dvec3& v) { return glm::dot(v, v); }

using Candidate = NearestCandidate;

// Compares the nearest point of a triangle with the best so far. That point is on the face if `p`
// lies within the three planes through the edges, otherwise on the nearest edge (the regions of
// Ericson 2005, Real-time collision detection, 5.1.5). A triangle without area has only edges, one
// without length only corners.
void compare(const glm::dvec3& p, const CornerPoints& corners, std::size_t slot, Candidate& best) {
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
    std::span<const glm::vec3> positions, std::span<const std::array<std::uint32_t, 3>> triangles)
    : tree_(buildTriangleBvh(positions, triangles, kMostInLeaf)) {
    corners_.reserve(triangles.size());
    for (const std::uint32_t triangle : tree_.order) {
        const auto& [a, b, c] = triangles[triangle];
        corners_.push_back({positions[a], positions[b], positions[c]});
    }
}

MeshPoint NearestSurface::operator()(const glm::dvec3& point) const {
    return meshPoint(nearest(point, std::numeric_limits<double>::max()), point);
}

std::optional<MeshPoint> NearestSurface::within(const glm::dvec3& point, double reach) const {
    const Candidate best = nearest(point, reach * reach);
    if (best.square >= reach * reach) return std::nullopt;
    return meshPoint(best, point);
}

Candidate NearestSurface::nearest(const glm::dvec3& point, double square) const {
    Candidate best{.square = square};
    forEachNearer(tree_, point, best.square, [&](std::size_t slot) {
        compare(point, corners_[slot], slot, best);
    });
    return best;
}

MeshPoint NearestSurface::meshPoint(const Candidate& best, const glm::dvec3& point) const {
    const CornerPoints& corners = corners_[best.slot];
    MeshPoint found{.triangle = tree_.order[best.slot], .weights = best.weights};
    for (int i = 0; i < 3; ++i)
        found.position += best.weights[i] * glm::dvec3(corners[static_cast<std::size_t>(i)]);
    found.distance = glm::distance(found.position, point);
    return found;
}

}  // namespace hair::groom
