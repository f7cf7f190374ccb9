#include "hair/groom/growth/ear_clipping.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <string>

#include "engine/error.h"

namespace hair {
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

// End points count. Where the boxes meet, collinear edges overlap.
bool edgesMeet(const Edge& p, const Edge& q) {
    if (!boxesMeet(p, q)) return false;
    return sign(orientation(p.a, p.b, q.a)) * sign(orientation(p.a, p.b, q.b)) <= 0 &&
           sign(orientation(q.a, q.b, p.a)) * sign(orientation(q.a, q.b, p.b)) <= 0;
}

// Whether the edges from b go back along each other.
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

// Twice the area, counter-clockwise positive. Below 2^(2 kGridBits + 1) for a simple polygon, and
// sums that overflow on the way wrap back.
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
        ++at;  // after a cut too: the next ear elsewhere, so that no vertex gets a fan of thin ones
    }
    triangles.push_back({rest[0], rest[1], rest[2]});
    return triangles;
}

}  // namespace hair
