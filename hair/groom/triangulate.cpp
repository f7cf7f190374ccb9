#include "hair/groom/triangulate.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

#include "engine/error.h"
#include "hair/groom/ear_clipping.h"
#include "hair/random.h"

// The polygon is cut into ears, the points inside are inserted one after the other, and edges are
// flipped until they are all Delaunay. Boundary edges have a triangle on one side only, so nothing
// flips them. Lawson 1977, Software for C1 surface interpolation; Guibas and Stolfi 1985 for the
// walk to a point.
namespace hair {
namespace {

constexpr std::uint32_t kNone = ~0u;

constexpr std::size_t after(std::size_t corner) { return (corner + 1) % 3; }
constexpr std::size_t before(std::size_t corner) { return (corner + 2) % 3; }

struct Cell {
    std::array<std::uint32_t, 3> vertices;    // counter-clockwise
    std::array<std::uint32_t, 3> neighbours;  // [corner], across the edge opposite; kNone outside
};

class Triangulation {
public:
    Triangulation(std::span<const GridPoint> points, std::uint32_t boundary_count);
    void insert(std::uint32_t point);
    const std::vector<Cell>& cells() const { return cells_; }

private:
    struct Edge {
        std::uint32_t cell;
        std::size_t corner;  // opposite
    };

    void linkNeighbours();
    std::uint32_t locate(std::uint32_t point) const;
    std::int64_t side(const Cell& cell, std::size_t corner, std::uint32_t point) const;
    bool contains(const Cell& cell, std::uint32_t point) const;
    void replaceNeighbour(std::uint32_t cell, std::uint32_t old_neighbour, std::uint32_t neighbour);
    std::size_t cornerFacing(std::uint32_t cell, std::uint32_t neighbour) const;
    void flip(Edge edge);
    void makeDelaunay();

    std::span<const GridPoint> points_;
    std::vector<Cell> cells_;
    std::vector<Edge> suspects_;  // edges that may not be Delaunay
    std::uint32_t last_ = 0;  // the cell where the last point went: the next one is near
};

Triangulation::Triangulation(std::span<const GridPoint> points, std::uint32_t boundary_count)
    : points_(points) {
    for (const auto& triangle : clipEars(points.first(boundary_count))) {
        cells_.push_back({triangle, {kNone, kNone, kNone}});
    }
    linkNeighbours();
    for (std::uint32_t cell = 0; cell < cells_.size(); ++cell) {
        for (std::size_t corner = 0; corner < 3; ++corner) suspects_.push_back({cell, corner});
    }
    makeDelaunay();
}

void Triangulation::linkNeighbours() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, Edge> edges;  // by directed end points
    for (std::uint32_t i = 0; i < cells_.size(); ++i) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t from = cells_[i].vertices[after(corner)];
            const std::uint32_t to = cells_[i].vertices[before(corner)];
            edges.insert({{from, to}, {i, corner}});
            if (const auto twin = edges.find({to, from}); twin != edges.end()) {
                cells_[i].neighbours[corner] = twin->second.cell;
                cells_[twin->second.cell].neighbours[twin->second.corner] = i;
            }
        }
    }
}

// Positive if the point is on the inner side of the edge opposite the corner, 0 if it is on its
// line.
std::int64_t Triangulation::side(const Cell& cell, std::size_t corner, std::uint32_t point) const {
    return orientation(
        points_[cell.vertices[after(corner)]], points_[cell.vertices[before(corner)]],
        points_[point]);
}

bool Triangulation::contains(const Cell& cell, std::uint32_t point) const {
    return side(cell, 0, point) >= 0 && side(cell, 1, point) >= 0 && side(cell, 2, point) >= 0;
}

// Walks across edges that have the point on their far side; where the boundary is in the way, looks
// at every cell.
std::uint32_t Triangulation::locate(std::uint32_t point) const {
    std::uint32_t at = last_;
    for (std::size_t steps = 0; at != kNone && steps < cells_.size(); ++steps) {
        const Cell& cell = cells_[at];
        if (contains(cell, point)) return at;
        at = kNone;
        for (std::size_t corner = 0; corner < 3 && at == kNone; ++corner) {
            if (side(cell, corner, point) < 0) at = cell.neighbours[corner];
        }
    }
    const auto found =
        std::ranges::find_if(cells_, [&](const Cell& cell) { return contains(cell, point); });
    if (found != cells_.end()) return static_cast<std::uint32_t>(found - cells_.begin());
    throw engine::Error("point " + std::to_string(point) + " is not inside the boundary");
}

void Triangulation::replaceNeighbour(
    std::uint32_t cell, std::uint32_t old_neighbour, std::uint32_t neighbour) {
    if (cell != kNone) cells_[cell].neighbours[cornerFacing(cell, old_neighbour)] = neighbour;
}

std::size_t Triangulation::cornerFacing(std::uint32_t cell, std::uint32_t neighbour) const {
    const auto& neighbours = cells_[cell].neighbours;
    const auto corner = std::ranges::find(neighbours, neighbour) - neighbours.begin();
    assert(corner < 3);
    return static_cast<std::size_t>(corner);
}

// The edge b-c between the cells a b c and d c b becomes a-d. The quadrilateral's sides become
// suspect.
void Triangulation::flip(Edge edge) {
    const std::uint32_t first = edge.cell;
    const std::uint32_t second = cells_[first].neighbours[edge.corner];
    const Cell p = cells_[first];
    const Cell q = cells_[second];
    const std::size_t i = edge.corner;
    const std::size_t j = cornerFacing(second, first);
    const std::uint32_t a = p.vertices[i];
    const std::uint32_t b = p.vertices[after(i)];
    const std::uint32_t c = p.vertices[before(i)];
    const std::uint32_t d = q.vertices[j];
    const std::uint32_t beyond_ca = p.neighbours[after(i)];
    const std::uint32_t beyond_bd = q.neighbours[after(j)];
    cells_[first] = {{a, b, d}, {beyond_bd, second, p.neighbours[before(i)]}};
    cells_[second] = {{a, d, c}, {q.neighbours[before(j)], beyond_ca, first}};
    replaceNeighbour(beyond_bd, second, first);
    replaceNeighbour(beyond_ca, first, second);
    for (const Edge side : {Edge{first, 0}, Edge{first, 2}, Edge{second, 0}, Edge{second, 1}}) {
        suspects_.push_back(side);
    }
}

void Triangulation::makeDelaunay() {
    while (!suspects_.empty()) {
        const Edge edge = suspects_.back();
        suspects_.pop_back();
        const Cell& cell = cells_[edge.cell];
        const std::uint32_t neighbour = cell.neighbours[edge.corner];
        if (neighbour == kNone) continue;
        const std::uint32_t opposite =
            cells_[neighbour].vertices[cornerFacing(neighbour, edge.cell)];
        if (inCircle(
                points_[cell.vertices[0]], points_[cell.vertices[1]], points_[cell.vertices[2]],
                points_[opposite])) {
            flip(edge);
        }
    }
}

void Triangulation::insert(std::uint32_t point) {
    const std::uint32_t first = locate(point);
    const auto second = static_cast<std::uint32_t>(cells_.size());
    const std::uint32_t third = second + 1;
    const auto [a, b, c] = cells_[first].vertices;
    const auto [beyond_bc, beyond_ca, beyond_ab] = cells_[first].neighbours;
    cells_[first] = {{a, b, point}, {second, third, beyond_ab}};
    cells_.push_back({{b, c, point}, {third, first, beyond_bc}});
    cells_.push_back({{c, a, point}, {first, second, beyond_ca}});
    replaceNeighbour(beyond_bc, first, second);
    replaceNeighbour(beyond_ca, first, third);
    last_ = first;

    for (const std::uint32_t cell : {first, second, third}) {
        if (side(cells_[cell], 2, point) > 0) {
            suspects_.push_back({cell, 2});
        } else if (cells_[cell].neighbours[2] != kNone) {
            flip({cell, 2});  // the point lies on this edge: the flat cell goes
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
    const auto twin = std::ranges::adjacent_find(order, {}, key);
    if (twin == order.end()) return;
    const auto [first, second] = std::minmax(twin[0], twin[1]);
    throw engine::Error(
        "points " + std::to_string(first) + " and " + std::to_string(second) + " coincide");
}

// Bits of x at the even places, of y at the odd ones: points that follow each other are close.
std::uint64_t mortonCode(GridPoint point) {
    std::uint64_t code = 0;
    for (int bit = 0; bit < kGridBits; ++bit) {
        code |= static_cast<std::uint64_t>((point.x >> bit & 1) | (point.y >> bit & 1) << 1)
                << 2 * bit;
    }
    return code;
}

// Rounds of random points, each about twice as large as the one before, along a curve within a
// round: walks stay short and so do flip cascades. Amenta, Choi and Rote 2003, Incremental
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
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (const Cell& cell : triangulation.cells()) triangles.push_back(cell.vertices);
    return triangles;
}

}  // namespace hair
