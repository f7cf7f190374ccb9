#include "hair/groom/growth/triangulate.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "engine/error.h"
#include "hair/groom/growth/ear_clipping.h"
#include "hair/groom/growth/triangle_net.h"
#include "hair/random.h"

// The polygon is cut into ears, the points inside are inserted one after the other, and edges are
// flipped until they are all Delaunay. Boundary edges have a triangle on one side only, so nothing
// flips them. Lawson 1977, Software for C1 surface interpolation; Guibas and Stolfi 1985 for the
// walk to a point.
namespace hair {
namespace {

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
    TriangleNet net_;
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
        points_[net_.vertex(TriangleNet::after(corner))],
        points_[net_.vertex(TriangleNet::before(corner))], points_[point]);
}

bool Triangulation::contains(std::uint32_t cell, std::uint32_t point) const {
    return side(3 * cell, point) >= 0 && side(3 * cell + 1, point) >= 0 &&
           side(3 * cell + 2, point) >= 0;
}

// Walks across edges that have the point on their far side; where the boundary is in the way, looks
// at every cell.
std::uint32_t Triangulation::locate(std::uint32_t point) const {
    const std::uint32_t cells = net_.cornerCount() / 3;
    std::uint32_t at = last_;
    for (std::uint32_t steps = 0; steps < cells; ++steps) {
        if (contains(at, point)) return at;
        std::uint32_t across = TriangleNet::kNone;
        for (std::uint32_t i = 0; i < 3 && across == TriangleNet::kNone; ++i) {
            if (side(3 * at + i, point) < 0) across = net_.twin(3 * at + i);
        }
        if (across == TriangleNet::kNone) break;
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
            points_[net_.vertex(first + 2)], points_[net_.vertex(net_.twin(corner))]);
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
        } else if (net_.twin(corner) != TriangleNet::kNone) {
            // The point lies on this edge: the flat cell goes.
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
    return triangulation.triangles();
}

}  // namespace hair
