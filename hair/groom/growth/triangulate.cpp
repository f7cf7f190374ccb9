#include "hair/groom/growth/triangulate.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string>

#include <glm/common.hpp>

#include "engine/error.h"
#include "hair/groom/growth/scalp_triangulation.h"
#include "hair/random.h"

namespace hair::groom {

// ---- Ears of a polygon --------------------------------------------------------------------------

namespace {

struct Edge {
    GridPoint a;
    GridPoint b;
};

bool boxesMeet(const Edge& p, const Edge& q) {
    const auto meet = [](std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) {
        return std::max(a, b) >= std::min(c, d) && std::max(c, d) >= std::min(a, b);
    };
    return meet(p.a.x, p.b.x, q.a.x, q.b.x) && meet(p.a.y, p.b.y, q.a.y, q.b.y);
}

int sign(std::int64_t value) { return (value > 0) - (value < 0); }

// Whether two edges have a point in common, end points included. Where the boxes meet, collinear
// edges overlap.
bool edgesMeet(const Edge& p, const Edge& q) {
    if (!boxesMeet(p, q)) return false;
    return sign(orientation(p.a, p.b, q.a)) * sign(orientation(p.a, p.b, q.b)) <= 0 &&
           sign(orientation(q.a, q.b, p.a)) * sign(orientation(q.a, q.b, p.b)) <= 0;
}

// Whether the two edges from b overlap.
bool foldsBack(GridPoint a, GridPoint b, GridPoint c) {
    return orientation(a, b, c) == 0 && (a.x - b.x) * (c.x - b.x) + (a.y - b.y) * (c.y - b.y) >= 0;
}

void checkSimple(std::span<const GridPoint> polygon) {
    const std::size_t n = polygon.size();
    const auto fail = [](std::size_t i, std::size_t j) {
        throw engine::Error(
            "the boundary meets itself: edges " + std::to_string(i) + " and " + std::to_string(j));
    };
    const auto edge = [&](std::size_t i) { return Edge{polygon[i], polygon[(i + 1) % n]}; };
    for (std::size_t i = 0; i < n; ++i) {
        if (foldsBack(polygon[i], polygon[(i + 1) % n], polygon[(i + 2) % n])) fail(i, (i + 1) % n);
        for (std::size_t j = i + 2; j < n; ++j) {
            const bool adjacent = i == 0 && j == n - 1;
            if (!adjacent && edgesMeet(edge(i), edge(j))) fail(i, j);
        }
    }
}

// Uses the sign of twice the area. It is below 2^(2 kGridBits + 1) for a simple polygon, and sums
// that overflow on the way wrap back.
bool isClockwise(std::span<const GridPoint> polygon) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const GridPoint& next = polygon[(i + 1) % polygon.size()];
        sum += static_cast<std::uint64_t>(orientation(polygon[0], polygon[i], next));
    }
    return static_cast<std::int64_t>(sum) < 0;
}

bool contains(GridPoint a, GridPoint b, GridPoint c, GridPoint p) {
    return orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> clipEars(std::span<const GridPoint> polygon) {
    if (polygon.size() < 3) throw engine::Error("a boundary needs at least 3 points");
    checkSimple(polygon);
    std::vector<std::uint32_t> rest(polygon.size());  // of the polygon, counter-clockwise
    std::iota(rest.begin(), rest.end(), 0u);
    if (isClockwise(polygon)) std::ranges::reverse(rest);

    std::vector<std::array<std::uint32_t, 3>> triangles;
    const auto isEar = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (orientation(polygon[a], polygon[b], polygon[c]) <= 0) return false;
        return std::ranges::none_of(rest, [&](std::uint32_t i) {
            return i != a && i != b && i != c &&
                   contains(polygon[a], polygon[b], polygon[c], polygon[i]);
        });
    };
    std::size_t at = 0;
    for (std::size_t failures = 0; rest.size() > 3;) {
        const std::size_t n = rest.size();
        at %= n;
        const std::uint32_t a = rest[(at + n - 1) % n];
        const std::uint32_t b = rest[at];
        const std::uint32_t c = rest[(at + 1) % n];
        if (isEar(a, b, c)) {
            triangles.push_back({a, b, c});
            rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(at));
            failures = 0;
        } else {
            assert(failures < n);
            ++failures;
        }
        ++at;  // after a cut, too, so that no vertex gets a fan of thin triangles
    }
    triangles.push_back({rest[0], rest[1], rest[2]});
    return triangles;
}

// ---- Delaunay triangulation of a polygon --------------------------------------------------------

namespace {

// The polygon is cut into ears, the points inside are inserted one after the other, and edges are
// flipped until they are all Delaunay. Boundary edges have a triangle on one side only, so nothing
// flips them. Lawson 1977, Software for C1 surface interpolation; Guibas and Stolfi 1985 for the
// walk to a point.

class Triangulation {
public:
    Triangulation(std::span<const GridPoint> points, std::uint32_t boundary_count);
    void insert(std::uint32_t point);
    std::vector<std::array<std::uint32_t, 3>> triangles() const { return net_.triangles(); }

private:
    std::uint32_t locate(std::uint32_t point) const;
    std::int64_t side(std::uint32_t corner, std::uint32_t point) const;
    bool contains(std::uint32_t cell, std::uint32_t point) const;
    void makeDelaunay();

    std::span<const GridPoint> points_;
    CornerTable net_;
    std::vector<std::uint32_t> suspects_;  // edges that may not be Delaunay, by opposite corner
    std::uint32_t last_ = 0;  // the cell where the last point went: the next one is near
};

Triangulation::Triangulation(std::span<const GridPoint> points, std::uint32_t boundary_count)
    : points_(points), net_(clipEars(points.first(boundary_count))) {
    for (std::uint32_t corner = 0; corner < net_.cornerCount(); ++corner)
        suspects_.push_back(corner);
    makeDelaunay();
}

// Positive if the point is on the inner side of the edge opposite the corner, 0 if it is on its
// line.
std::int64_t Triangulation::side(std::uint32_t corner, std::uint32_t point) const {
    return orientation(
        points_[net_.vertex(CornerTable::after(corner))],
        points_[net_.vertex(CornerTable::before(corner))], points_[point]);
}

bool Triangulation::contains(std::uint32_t cell, std::uint32_t point) const {
    return side(3 * cell, point) >= 0 && side(3 * cell + 1, point) >= 0 &&
           side(3 * cell + 2, point) >= 0;
}

// Walks across edges that have the point on their far side; if the boundary is in the way, looks at
// every cell.
std::uint32_t Triangulation::locate(std::uint32_t point) const {
    const std::uint32_t cells = net_.cornerCount() / 3;
    std::uint32_t at = last_;
    for (std::uint32_t steps = 0; steps < cells; ++steps) {
        if (contains(at, point)) return at;
        std::uint32_t across = CornerTable::kNone;
        for (std::uint32_t i = 0; i < 3 && across == CornerTable::kNone; ++i) {
            if (side(3 * at + i, point) < 0) across = net_.opposite(3 * at + i);
        }
        if (across == CornerTable::kNone) break;
        at = across / 3;
    }
    for (std::uint32_t cell = 0; cell < cells; ++cell) {
        if (contains(cell, point)) return cell;
    }
    throw engine::Error("point " + std::to_string(point) + " is not inside the boundary");
}

void Triangulation::makeDelaunay() {
    const auto isBad = [&](std::uint32_t corner) {
        const std::uint32_t first = corner / 3 * 3;
        return inCircle(
            points_[net_.vertex(first)], points_[net_.vertex(first + 1)],
            points_[net_.vertex(first + 2)], points_[net_.vertex(net_.opposite(corner))]);
    };
    constexpr auto no_limit = std::numeric_limits<std::size_t>::max();
    flipEdges(net_, suspects_, no_limit, isBad, [](std::uint32_t) {});
}

void Triangulation::insert(std::uint32_t point) {
    last_ = locate(point);
    for (const std::uint32_t cell : net_.split(last_, point)) {
        const std::uint32_t corner = 3 * cell + 2;
        if (side(corner, point) > 0) {
            suspects_.push_back(corner);
        } else if (net_.opposite(corner) != CornerTable::kNone) {
            // The point lies on this edge: a flip removes the flat cell.
            for (const std::uint32_t flipped : net_.flip(corner)) suspects_.push_back(flipped);
        } else {
            throw engine::Error("point " + std::to_string(point) + " lies on the boundary");
        }
    }
    makeDelaunay();
}

std::vector<GridPoint> snapToGrid(std::span<const glm::dvec2> points) {
    glm::dvec2 low = points.front();
    glm::dvec2 high = points.front();
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!std::isfinite(points[i].x) || !std::isfinite(points[i].y)) {
            throw engine::Error("point " + std::to_string(i) + " is not finite");
        }
        low = {std::min(low.x, points[i].x), std::min(low.y, points[i].y)};
        high = {std::max(high.x, points[i].x), std::max(high.y, points[i].y)};
    }
    const double extent = std::max(high.x - low.x, high.y - low.y);
    const double scale = extent > 0.0 ? ((1 << kGridBits) - 1) / extent : 0.0;
    std::vector<GridPoint> snapped;
    for (const glm::dvec2& point : points) {
        snapped.push_back(
            {std::llround((point.x - low.x) * scale), std::llround((point.y - low.y) * scale)});
    }
    return snapped;
}

void checkDistinct(std::span<const GridPoint> points) {
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t i) { return std::pair(points[i].x, points[i].y); };
    std::ranges::sort(order, {}, key);
    const auto opposite = std::ranges::adjacent_find(order, {}, key);
    if (opposite == order.end()) return;
    const auto [first, second] = std::minmax(opposite[0], opposite[1]);
    throw engine::Error(
        "points " + std::to_string(first) + " and " + std::to_string(second) + " coincide");
}

// Interleaves the bits of x, at the even places, with those of y, at the odd ones, so that points
// that follow each other are close.
std::uint64_t mortonCode(GridPoint point) {
    std::uint64_t code = 0;
    for (int bit = 0; bit < kGridBits; ++bit) {
        code |= static_cast<std::uint64_t>((point.x >> bit & 1) | (point.y >> bit & 1) << 1)
                << 2 * bit;
    }
    return code;
}

// Orders points in random rounds, each about twice as large as the one before, and along a curve
// within a round. This keeps walks and flip cascades short. Amenta, Choi and Rote 2003, Incremental
// constructions con BRIO.
std::vector<std::uint32_t> insertionOrder(std::span<const GridPoint> points, std::uint32_t first) {
    struct Entry {
        int round;
        std::uint64_t code;
        std::uint32_t point;
        auto operator<=>(const Entry&) const = default;
    };
    std::vector<Entry> entries;
    for (auto i = first; i < points.size(); ++i) {
        entries.push_back({-std::countl_zero(pcg(i)), mortonCode(points[i]), i});
    }
    std::ranges::sort(entries);
    std::vector<std::uint32_t> order;
    for (const Entry& entry : entries) order.push_back(entry.point);
    return order;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>>
triangulate(std::span<const glm::dvec2> points, std::uint32_t boundary_count) {
    assert(boundary_count <= points.size());
    if (boundary_count < 3) throw engine::Error("a boundary needs at least 3 points");
    const std::vector<GridPoint> snapped = snapToGrid(points);
    checkDistinct(snapped);
    Triangulation triangulation(snapped, boundary_count);
    for (const std::uint32_t point : insertionOrder(snapped, boundary_count)) {
        triangulation.insert(point);
    }
    return triangulation.triangles();
}

// ---- Triangles of a scalp cut at roots ----------------------------------------------------------

namespace {

// Least weight of each corner at a root, so that rounding puts no root on an edge.
constexpr double kLeastWeight = 1e-6;

// Cuts a triangle at its roots, in the plane of weights. This plane is affine to space, so the
// triangles are Delaunay only after makeDelaunay().
void cut(
    std::vector<std::array<std::uint32_t, 3>>& triangles,
    const std::array<std::uint32_t, 3>& corners, std::span<const std::uint32_t> members,
    std::span<const SurfacePoint> roots) {
    if (members.empty()) {
        triangles.push_back(corners);
        return;
    }
    std::vector<glm::dvec2> flat{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}};
    for (const std::uint32_t root : members) {
        const glm::dvec3 weights = glm::max(glm::dvec3(roots[root].weights), kLeastWeight);
        flat.push_back(glm::dvec2(weights.y, weights.z) / (weights.x + weights.y + weights.z));
    }
    for (const auto& triangle : triangulate(flat, 3)) {
        auto& vertices = triangles.emplace_back();
        for (std::size_t i = 0; i < 3; ++i)
            vertices[i] = triangle[i] < 3 ? corners[triangle[i]] : members[triangle[i] - 3];
    }
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>>
cutAtRoots(const Scalp& scalp, std::span<const SurfacePoint> roots) {
    std::vector<std::vector<std::uint32_t>> members(scalp.triangles.size());
    for (std::uint32_t i = 0; i < roots.size(); ++i) members[roots[i].triangle].push_back(i);
    const auto first = static_cast<std::uint32_t>(roots.size());
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t i = 0; i < scalp.triangles.size(); ++i) {
        const auto [a, b, c] = scalp.triangles[i];
        cut(triangles, {first + a, first + b, first + c}, members[i], roots);
    }
    return triangles;
}

// ---- Triangles between roots on a surface -------------------------------------------------------

namespace {

// Returns the piece of each triangle of the scalp: a number that triangles have in common if edges
// connect them.
std::vector<std::uint32_t> pieces(const Scalp& scalp) {
    const CornerTable net(scalp.triangles);
    std::vector<std::uint32_t> parent(scalp.triangles.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (std::uint32_t corner = 0; corner < net.cornerCount(); ++corner) {
        if (net.opposite(corner) != CornerTable::kNone)
            parent[root(corner / 3)] = root(net.opposite(corner) / 3);
    }
    for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = root(i);
    return parent;
}

// Joins the roots of pieces without a triangle.
void joinLonely(
    std::vector<std::array<std::uint32_t, 3>>& triangles, const Scalp& scalp,
    std::span<const SurfacePoint> roots) {
    const std::vector<std::uint32_t> piece = pieces(scalp);
    std::vector<bool> spanned(scalp.triangles.size(), false);  // [piece]
    for (const auto& triangle : triangles) spanned[piece[roots[triangle[0]].triangle]] = true;
    std::map<std::uint32_t, std::vector<std::uint32_t>> lonely;  // roots by piece
    for (std::uint32_t i = 0; i < roots.size(); ++i) {
        const std::uint32_t home = piece[roots[i].triangle];
        if (!spanned[home]) lonely[home].push_back(i);
    }
    for (const auto& [home, members] : lonely) {
        if (members.size() == 1) triangles.push_back({members[0], members[0], members[0]});
        for (std::size_t i = 1; i < members.size(); ++i)
            triangles.push_back({members[i - 1], members[i], members[i]});
    }
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>>
surfaceTriangles(const Scalp& scalp, std::span<const SurfacePoint> roots) {
    ScalpTriangulation net(scalp, roots, cutAtRoots(scalp, roots));
    net.makeDelaunay();
    net.removeScalpVertices();
    net.makeDelaunay();
    net.peel();
    std::vector<std::array<std::uint32_t, 3>> triangles = net.triangles();
    joinLonely(triangles, scalp, roots);
    return triangles;
}

}  // namespace hair::groom
