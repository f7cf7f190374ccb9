#include "hair/groom/growth/triangulate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "engine/process.h"
#include "hair/random.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace hair::groom {
namespace {

using testing::HasSubstr;
using Points = std::vector<glm::dvec2>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

double cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double polygonArea(const Points& points, std::size_t boundary) {
    double sum = 0.0;
    for (std::size_t i = 0; i < boundary; ++i) {
        const glm::dvec2& a = points[i];
        const glm::dvec2& b = points[(i + 1) % boundary];
        sum += a.x * b.y - a.y * b.x;
    }
    return std::abs(0.5 * sum);
}

bool isInside(const Points& points, std::size_t boundary, const glm::dvec2& p) {
    bool inside = false;
    for (std::size_t i = 0; i < boundary; ++i) {
        const glm::dvec2& a = points[i];
        const glm::dvec2& b = points[(i + 1) % boundary];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) {
            inside = !inside;
        }
    }
    return inside;
}

// The depth of d inside the circle through a, b and c, in units of its radius.
double
depthInCircle(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
    const glm::dvec2 u = b - a;
    const glm::dvec2 v = c - a;
    const double twice = 2.0 * (u.x * v.y - u.y * v.x);
    const double uu = glm::dot(u, u);
    const double vv = glm::dot(v, v);
    const glm::dvec2 centre = a + glm::dvec2(v.y * uu - u.y * vv, u.x * vv - v.x * uu) / twice;
    const double radius = glm::distance(centre, a);
    return (radius - glm::distance(centre, d)) / radius;
}

// Checks all conditions for a triangulation of this polygon with these points.
void expectTriangulates(const Triangles& triangles, const Points& points, std::size_t boundary) {
    ASSERT_EQ(triangles.size(), 2 * points.size() - 2 - boundary);  // Euler
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    std::set<std::uint32_t> used;
    double area = 0.0;
    for (const auto& [a, b, c] : triangles) {
        const double twice = cross(points[a], points[b], points[c]);
        EXPECT_GT(twice, 0.0);
        area += 0.5 * twice;
        for (const auto& edge : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
            EXPECT_EQ(++edges[edge], 1) << "two triangles on one side of an edge";
        }
        used.insert({a, b, c});
    }
    EXPECT_EQ(used.size(), points.size());
    // Rounding to 2^-29 of the extent moves the area by less than perimeter * extent * 2^-29.
    EXPECT_NEAR(area, polygonArea(points, boundary), 1e-7 * area);
    std::size_t open = 0;
    for (const auto& [edge, count] : edges) {
        if (edges.contains({edge.second, edge.first})) continue;
        ++open;
        const std::uint32_t step =
            edge.second > edge.first ? edge.second - edge.first : edge.first - edge.second;
        EXPECT_TRUE(step == 1 || step == boundary - 1) << "an open edge that isn't the boundary's";
        EXPECT_LT(std::max(edge.first, edge.second), boundary);
    }
    EXPECT_EQ(open, boundary);
}

// Brute force: no circle through a triangle holds the opposite corner of a neighbour across an
// inner edge. By Delaunay's lemma that makes the triangulation the constrained Delaunay one.
void expectLocallyDelaunay(const Triangles& triangles, const Points& points) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> opposite;
    for (const auto& [a, b, c] : triangles) {
        opposite[{a, b}] = c;
        opposite[{b, c}] = a;
        opposite[{c, a}] = b;
    }
    for (const auto& [edge, corner] : opposite) {
        const auto twin = opposite.find({edge.second, edge.first});
        if (twin == opposite.end()) continue;
        // The rounding of the coordinates, far above 2^-29, far below any real error.
        EXPECT_LT(
            depthInCircle(
                points[edge.first], points[edge.second], points[corner], points[twin->second]),
            1e-6);
    }
}

glm::dvec2 randomPoint(std::uint32_t seed, std::uint32_t index) {
    return {random01(seed, index, 100), random01(seed, index, 101)};
}

Points regularPolygon(std::uint32_t count) {
    Points points;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / count;
        points.emplace_back(std::cos(angle), std::sin(angle));
    }
    return points;
}

// A polygon seen from the origin with random radii: any number of reflex corners.
Points star(std::uint32_t count, std::uint32_t seed) {
    Points points = regularPolygon(count);
    for (std::uint32_t i = 0; i < count; ++i) points[i] *= 0.3 + 0.7 * random01(seed, i, 102);
    return points;
}

void addInside(Points& points, std::size_t boundary, std::size_t count, std::uint32_t seed) {
    for (std::uint32_t i = 0; points.size() < boundary + count; ++i) {
        const glm::dvec2 point = 2.0 * randomPoint(seed, i) - 1.0;
        if (isInside(points, boundary, point)) points.push_back(point);
    }
}

TEST(Triangulate, KeepsASingleTriangle) {
    const Points points{{0, 0}, {1, 0}, {0, 1}};
    expectTriangulates(triangulate(points, 3), points, 3);
}

TEST(Triangulate, TurnsAClockwisePolygonRound) {
    const Points points{{0, 0}, {0, 1}, {1, 1}, {1, 0}, {0.5, 0.4}};
    expectTriangulates(triangulate(points, 4), points, 4);
}

// Only one of a quadrilateral's two diagonals is Delaunay: the short one of this rhombus.
TEST(Triangulate, TakesTheShortDiagonalOfARhombus) {
    const Points points{{-2, 0}, {0, -1}, {2, 0}, {0, 1}};
    for (const auto& triangle : triangulate(points, 4)) {
        EXPECT_TRUE(std::ranges::count(triangle, 1u) == 1 && std::ranges::count(triangle, 3u) == 1);
    }
}

TEST(Triangulate, CoversAnyStarWithAnyPoints) {
    for (std::uint32_t seed = 0; seed < 60; ++seed) {
        const std::uint32_t boundary = 3 + hash(seed, 0, 103) % 60;
        Points points = star(boundary, seed);
        addInside(points, boundary, hash(seed, 1, 103) % 200, seed);
        const Triangles triangles = triangulate(points, boundary);
        SCOPED_TRACE("seed " + std::to_string(seed));
        expectTriangulates(triangles, points, boundary);
        expectLocallyDelaunay(triangles, points);
    }
}

// In a convex polygon no boundary edge is in the way, so no circle contains any point.
TEST(Triangulate, LeavesEveryCircleEmptyInAConvexPolygon) {
    for (std::uint32_t seed = 0; seed < 10; ++seed) {
        Points points = regularPolygon(17);
        for (glm::dvec2& point : points) point *= glm::dvec2(1.0, 0.6);  // not cocircular
        addInside(points, 17, 120, seed);
        for (const auto& [a, b, c] : triangulate(points, 17)) {
            for (const glm::dvec2& point : points) {
                EXPECT_LT(depthInCircle(points[a], points[b], points[c], point), 1e-6);
            }
        }
    }
}

TEST(Triangulate, TakesCocircularPoints) {
    const Points polygon = regularPolygon(64);
    expectTriangulates(triangulate(polygon, 64), polygon, 64);
    Points rings = polygon;
    for (const double radius : {0.75, 0.5, 0.25}) {
        for (const glm::dvec2& point : polygon) rings.push_back(radius * point);
    }
    rings.emplace_back(0.0, 0.0);
    expectTriangulates(triangulate(rings, 64), rings, 64);
}

// Points lie on the lines between others, on existing edges and on straight parts of the boundary.
TEST(Triangulate, TakesASquareGrid) {
    constexpr int n = 12;
    Points points;
    for (int i = 0; i < n; ++i) points.emplace_back(i, 0);
    for (int i = 0; i < n; ++i) points.emplace_back(n, i);
    for (int i = n; i > 0; --i) points.emplace_back(i, n);
    for (int i = n; i > 0; --i) points.emplace_back(0, i);
    for (int y = 1; y < n; ++y) {
        for (int x = 1; x < n; ++x) points.emplace_back(x, y);
    }
    const Triangles triangles = triangulate(points, 4 * n);
    expectTriangulates(triangles, points, 4 * n);
    for (const auto& [a, b, c] : triangles) {  // halves of unit squares, whichever diagonal cuts
                                               // them
        EXPECT_NEAR(cross(points[a], points[b], points[c]), 1.0, 1e-6);
    }
}

// In a comb, the walk to a point meets the boundary again and again.
TEST(Triangulate, CoversACombWithPoints) {
    Points points;
    constexpr int teeth = 20;
    for (int i = 0; i < teeth; ++i) {
        points.emplace_back(-1.0 + 2.0 * i / teeth, 1.0);
        points.emplace_back(-1.0 + 2.0 * (i + 0.5) / teeth, -0.8);
    }
    points.emplace_back(1.0, 1.0);
    points.emplace_back(1.0, -1.0);
    points.emplace_back(-1.0, -1.0);
    const auto boundary = static_cast<std::uint32_t>(points.size());
    addInside(points, boundary, 500, 5);
    const Triangles triangles = triangulate(points, boundary);
    expectTriangulates(triangles, points, boundary);
    expectLocallyDelaunay(triangles, points);
}

TEST(Triangulate, DoesNotDependOnPlaceAndScale) {
    Points points = star(20, 3);
    addInside(points, 20, 50, 3);
    const Triangles triangles = triangulate(points, 20);
    for (glm::dvec2& point : points) point = 1024.0 * point + glm::dvec2(4096.0, -512.0);
    EXPECT_EQ(triangulate(points, 20), triangles);
}

// For eight times as many points within the same boundary, N log N makes 10 times the work, N^1.5
// 23 times, and N^2 64 times.
TEST(Triangulate, TakesLittleMoreThanInProportionToItsPoints) {
    constexpr std::uint32_t boundary = 50;
    const auto timed = [](std::uint32_t count) {
        Points points = star(boundary, 9);
        addInside(points, boundary, count, 9);
        const double start = engine::threadTime();
        const Triangles triangles = triangulate(points, boundary);
        const double time = engine::threadTime() - start;
        expectTriangulates(triangles, points, boundary);
        expectLocallyDelaunay(triangles, points);
        return time;
    };
    const double few = timed(2500);
    EXPECT_LT(timed(20000), 32.0 * few);
}

TEST(Triangulate, RefusesPointsThatCoincide) {
    const Points points{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0.5}, {0.25, 0.5}, {0.5, 0.5}};
    EXPECT_EQ(errorText([&] { triangulate(points, 4); }), "points 4 and 6 coincide");
    EXPECT_EQ(
        errorText([&] { triangulate(Points(4, glm::dvec2(1.0)), 4); }), "points 0 and 1 coincide");
}

TEST(Triangulate, RefusesPointsThatAreNotInside) {
    for (const glm::dvec2 point : {glm::dvec2(2, 2), glm::dvec2(0.5, 1.5), glm::dvec2(0.5, 0.0)}) {
        const Points points{{0, 0}, {1, 0}, {1, 1}, {0, 1}, point};
        EXPECT_THAT(errorText([&] { triangulate(points, 4); }), HasSubstr("point 4"));
    }
    const Points notch{{0, 0}, {4, 0}, {4, 4},
                       {2, 1}, {0, 4}, {2, 3}};  // in the notch, not in the polygon
    EXPECT_THAT(errorText([&] { triangulate(notch, 5); }), HasSubstr("point 5 is not inside"));
}

TEST(Triangulate, RefusesBoundariesThatMeetThemselves) {
    const Points bow_tie{{0, 0}, {1, 1}, {1, 0}, {0, 1}};
    EXPECT_THAT(errorText([&] { triangulate(bow_tie, 4); }), HasSubstr("meets itself"));
    const Points touching{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}};
    EXPECT_THAT(errorText([&] { triangulate(touching, 5); }), HasSubstr("meets itself"));
    const Points spike{{0, 0}, {4, 0}, {2, 0}, {2, 4}};
    EXPECT_THAT(errorText([&] { triangulate(spike, 4); }), HasSubstr("meets itself"));
    const Points flat{{0, 0}, {1, 0}, {2, 0}};
    EXPECT_THAT(errorText([&] { triangulate(flat, 3); }), HasSubstr("meets itself"));
}

TEST(Triangulate, RefusesTooFewOrInfinitePoints) {
    const Points two{{0, 0}, {1, 0}};
    EXPECT_THAT(errorText([&] { triangulate(two, 2); }), HasSubstr("at least 3"));
    const Points infinite{{0, 0}, {1, 0}, {0, HUGE_VAL}};
    EXPECT_EQ(errorText([&] { triangulate(infinite, 3); }), "point 2 is not finite");
}

TEST(GridPoint, IsExactAtItsLimits) {
    constexpr std::int64_t most = (std::int64_t{1} << kGridBits) - 1;
    EXPECT_EQ(orientation({0, 0}, {most, most}, {most - 1, most - 1}), 0);
    EXPECT_GT(orientation({0, 0}, {most, most - 1}, {most, most}), 0);
    // The corners of a square lie on one circle; a step inward is inside, a step outward is not.
    EXPECT_FALSE(inCircle({0, 0}, {most, 0}, {most, most}, {0, most}));
    EXPECT_TRUE(inCircle({0, 0}, {most, 0}, {most, most}, {0, most - 1}));
    EXPECT_FALSE(inCircle({0, 0}, {most, 0}, {most, most - 1}, {0, most}));
}

TEST(ClipEars, GivesTwoTrianglesLessThanVertices) {
    const std::vector<GridPoint> square{{0, 0}, {5, 0}, {9, 0}, {9, 9}, {4, 9}, {0, 9}, {0, 3}};
    std::int64_t twice_area = 0;
    const auto triangles = clipEars(square);
    EXPECT_EQ(triangles.size(), 5u);
    for (const auto& [a, b, c] : triangles) {
        EXPECT_GT(orientation(square[a], square[b], square[c]), 0);
        twice_area += orientation(square[a], square[b], square[c]);
    }
    EXPECT_EQ(twice_area, 2 * 81);
}

}  // namespace
}  // namespace hair::groom
