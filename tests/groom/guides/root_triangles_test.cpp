#include "hair/groom/guides/root_triangles.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <gmock/gmock.h>

#include "hair/random.h"
#include "tests/groom/style/sample_strands.h"
#include "tests/groom/test_meshes.h"

namespace hair::groom {
namespace {

using testing::ElementsAre;
using Triangle = std::array<std::uint32_t, 3>;
using TriangleList = std::vector<Triangle>;

// Strands with one segment along `direction`.
Groom rooted(const std::vector<glm::dvec3>& roots, const glm::dvec3& direction = {0, 0.1, 0}) {
    return sampleGroom(
        static_cast<std::uint32_t>(roots.size()), 2,
        [&](std::uint32_t strand, double t) { return roots[strand] + t * direction; });
}

// Evenly on a sphere of 0.1 m down to a height, by the golden angle.
std::vector<glm::dvec3> onSphere(std::uint32_t count, double lowest) {
    std::vector<glm::dvec3> roots;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double y = 1.0 - (1.0 - lowest) * (i + 0.5) / count;
        const double turn = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
        const double r = std::sqrt(1.0 - y * y);
        roots.push_back(0.1 * glm::dvec3(r * std::cos(turn), y, r * std::sin(turn)));
    }
    return roots;
}

std::vector<glm::dvec3> square(int side, double spacing) {
    std::vector<glm::dvec3> roots;
    for (int i = 0; i < side * side; ++i)
        roots.push_back(spacing * glm::dvec3(i % side, 0.0, i / side));
    return roots;
}

std::array<glm::dvec3, 3> cornersOf(const Groom& groom, const Triangle& triangle) {
    return {
        glm::dvec3(groom.strand(triangle[0])[0]), glm::dvec3(groom.strand(triangle[1])[0]),
        glm::dvec3(groom.strand(triangle[2])[0])};
}

glm::dvec3 areaVector(const Groom& groom, const Triangle& triangle) {
    const auto [a, b, c] = cornersOf(groom, triangle);
    return 0.5 * glm::cross(b - a, c - a);
}

double area(const Groom& groom, const TriangleList& triangles) {
    double sum = 0.0;
    for (const Triangle& triangle : triangles) sum += glm::length(areaVector(groom, triangle));
    return sum;
}

// How many triangles lie on each edge, in either direction.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> edgesOf(const TriangleList& triangles) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const Triangle& triangle : triangles)
        for (std::size_t k = 0; k < 3; ++k)
            ++edges[std::minmax({triangle[k], triangle[(k + 1) % 3]})];
    return edges;
}

// The Delaunay triangles of points on a sphere are the faces of the convex hull (Brown 1979): all
// points are on the inner side of each face. Floats are rounded at 0.1.
void expectDelaunayOnSphere(const Groom& groom, const TriangleList& triangles) {
    for (const Triangle& triangle : triangles) {
        const glm::dvec3 outward = glm::normalize(areaVector(groom, triangle));
        const glm::dvec3 corner(groom.strand(triangle[0])[0]);
        EXPECT_GT(glm::dot(outward, corner), 0.0);
        for (std::uint32_t i = 0; i < groom.strand_count; ++i)
            EXPECT_LT(glm::dot(outward, glm::dvec3(groom.strand(i)[0]) - corner), 1e-7);
    }
}

TEST(TriangulateRoots, JoinsOneTwoAndThree) {
    EXPECT_THAT(triangulateRoots(rooted({{1, 2, 3}}), nullptr), ElementsAre(Triangle{0, 0, 0}));
    for (const double x : {-1.0, 1.0})
        EXPECT_THAT(
            triangulateRoots(rooted({{0, 0, 0}, {x, 0.2, 0.3}}), nullptr),
            ElementsAre(Triangle{0, 1, 1}));
    const TriangleList one = triangulateRoots(rooted({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}), nullptr);
    ASSERT_EQ(one.size(), 1u);
    EXPECT_GT(areaVector(rooted({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}), one[0]).y, 0.0);
}

TEST(TriangulateRoots, JoinsNeighboursAlongALine) {
    std::vector<glm::dvec3> roots;
    for (const double along : {0.0, 0.5, 0.1, 0.3}) roots.push_back(along * glm::dvec3(1, -2, 0.5));
    EXPECT_THAT(
        triangulateRoots(rooted(roots), nullptr),
        ElementsAre(Triangle{0, 2, 2}, Triangle{2, 3, 3}, Triangle{3, 1, 1}));
}

TEST(TriangulateRoots, TakesRootsAtOnePlace) {
    EXPECT_THAT(
        triangulateRoots(rooted(std::vector(3, glm::dvec3(0.1, 0.2, 0.3))), nullptr),
        ElementsAre(Triangle{0, 1, 1}, Triangle{1, 2, 2}));
    EXPECT_TRUE(triangulateRoots(rooted({}), nullptr).empty());
}

TEST(TriangulateRoots, CoversAPatchOnTheSideOfItsHair) {
    const std::vector<glm::dvec3> roots = square(9, 0.01);
    for (const double up : {-0.1, 0.1}) {
        const Groom groom = rooted(roots, {0.02, up, 0.0});
        const TriangleList triangles = triangulateRoots(groom, nullptr);
        EXPECT_EQ(triangles.size(), 128u);
        EXPECT_NEAR(area(groom, triangles), 0.08 * 0.08, 1e-9);
        for (const Triangle& triangle : triangles)
            EXPECT_GT(areaVector(groom, triangle).y * up, 0.0);
    }
}

TEST(TriangulateRoots, LeavesOutRootsAtATakenPlace) {
    std::vector<glm::dvec3> roots = square(5, 0.01);
    const std::vector<glm::dvec3> again = roots;
    roots.insert(roots.end(), again.begin(), again.end());
    const TriangleList triangles = triangulateRoots(rooted(roots), nullptr);
    EXPECT_EQ(triangles.size(), 32u);
    for (const Triangle& triangle : triangles) EXPECT_LT(std::ranges::max(triangle), 25u);
}

// A cap of half angle 100 degrees. Its hairline is as even as its inside, so no triangle is left
// out. By Euler's formula, n roots with h of them on the hairline make one piece of 2 n - 2 - h
// triangles.
TEST(TriangulateRoots, CoversACap) {
    const Groom groom = rooted(onSphere(800, std::cos(1.75)));
    const TriangleList triangles = triangulateRoots(groom, nullptr);
    expectDelaunayOnSphere(groom, triangles);
    const double cap = 2.0 * std::numbers::pi * 0.01 * (1.0 - std::cos(1.75));
    // The outermost roots are half a spacing inside, 4 % of the area; flat triangles take 1 %.
    EXPECT_GT(area(groom, triangles), 0.93 * cap);
    EXPECT_LT(area(groom, triangles), cap);
    std::set<std::uint32_t> used;
    for (const Triangle& triangle : triangles) used.insert(triangle.begin(), triangle.end());
    EXPECT_EQ(used.size(), 800u);
}

TEST(TriangulateRoots, DoesNotDependOnPlaceAndDirection) {
    const glm::dmat3 turn{{0.36, 0.48, -0.8}, {-0.8, 0.6, 0.0}, {0.48, 0.64, 0.6}};  // a rotation
    std::vector<glm::dvec3> roots = onSphere(300, 0.0);
    const auto asSet = [](const TriangleList& triangles) {
        std::set<Triangle> set;
        for (Triangle t : triangles) {
            std::ranges::rotate(t, std::ranges::min_element(t));
            set.insert(t);
        }
        return set;
    };
    const auto here = asSet(triangulateRoots(rooted(roots), nullptr));
    for (glm::dvec3& root : roots) root = turn * root + glm::dvec3(0.3, 1.6, -0.2);
    EXPECT_EQ(asSet(triangulateRoots(rooted(roots), nullptr)), here);
}

// A cap with a face: no triangle reaches over the face, and all other triangles stay.
TEST(TriangulateRoots, LeavesAFaceFree) {
    std::vector<glm::dvec3> roots = onSphere(1000, -0.2);
    const auto isFace = [](const glm::dvec3& p) { return p.z > 0.03 && p.y < 0.06; };
    std::erase_if(roots, isFace);
    const Groom groom = rooted(roots);
    const TriangleList triangles = triangulateRoots(groom, nullptr);
    expectDelaunayOnSphere(groom, triangles);
    const double spacing = std::sqrt(2.0 * std::numbers::pi * 0.01 * 1.2 / 1000.0);
    for (const Triangle& triangle : triangles) {
        const auto [a, b, c] = cornersOf(groom, triangle);
        const glm::dvec3 centre = 0.1 * glm::normalize(a + b + c);
        // Triangles have edges of at most three spacings, so none reaches so deep into the face.
        EXPECT_TRUE(centre.z <= 0.03 + 2.0 * spacing || centre.y >= 0.06 - 2.0 * spacing);
    }
    const auto edges = edgesOf(triangles);
    // Inside, triangles are on both sides of all edges.
    for (const auto& [edge, count] : edges) {
        const glm::dvec3 p(groom.strand(edge.first)[0]);
        if (p.z < -0.01 && p.y > 0.0) {
            EXPECT_EQ(count, 2);
        }
    }
}

TEST(TriangulateRoots, LeavesAWidePartingFree) {
    std::vector<glm::dvec3> roots = square(10, 0.01);
    for (glm::dvec3& root : roots)
        if (root.x > 0.045) root.x += 0.04;  // a gap of 5 rows, or 3.5 diagonals
    const Groom groom = rooted(roots);
    const TriangleList triangles = triangulateRoots(groom, nullptr);
    EXPECT_EQ(triangles.size(), 2u * 2u * 4u * 9u);
    EXPECT_NEAR(area(groom, triangles), 2.0 * 0.04 * 0.09, 1e-9);
    for (glm::dvec3& root : roots)
        if (root.x > 0.045) root.x -= 0.03;  // a gap of 2 rows
    EXPECT_EQ(triangulateRoots(rooted(roots), nullptr).size(), 2u * 9u * 9u);
}

// The surface of a sphere, closed: 2 n - 4 triangles, each edge between two (Euler).
TEST(TriangulateRoots, GoesAllRoundASphere) {
    const Groom groom = rooted(onSphere(500, -1.0));
    const TriangleList triangles = triangulateRoots(groom, nullptr);
    EXPECT_EQ(triangles.size(), 996u);
    expectDelaunayOnSphere(groom, triangles);
    for (const auto& [edge, count] : edgesOf(triangles)) EXPECT_EQ(count, 2);
}

// Roots along a curve in space, like a moustache, lie neither on a sphere nor on a line.
TEST(TriangulateRoots, TakesANarrowStrip) {
    std::vector<glm::dvec3> roots;
    for (int i = 0; i < 90; ++i) {
        const double along = 0.03 * (i / 3 - 15);
        roots.emplace_back(0.1 * along, 0.003 * (i % 3), 0.1 * std::cos(along));
    }
    const Groom groom = rooted(roots, {0, 0, 0.1});
    const TriangleList triangles = triangulateRoots(groom, nullptr);
    EXPECT_NEAR(area(groom, triangles), 0.006 * 0.003 * 29, 0.1 * 0.006 * 0.003 * 29);
    for (const Triangle& triangle : triangles) EXPECT_GT(areaVector(groom, triangle).z, 0.0);
}

// Random roots have no even spacing, but large gaps are rare. With density n, circles of radius r
// through three points are empty for a share (1 + x) exp(-x) of the triangles, x = pi r^2 n; an
// edge of three times the median one, about 1 / sqrt(n), needs r = 1.5 / sqrt(n): 0.7 %, or fewer
// if the median is above that.
TEST(TriangulateRoots, DropsFewTrianglesOfRandomRoots) {
    std::vector<glm::dvec3> roots;
    for (std::uint32_t i = 0; i < 3000; ++i)
        roots.emplace_back(random01(1, i, 1), 0.0, random01(1, i, 2));
    const Groom groom = rooted(roots);
    const TriangleList triangles = triangulateRoots(groom, nullptr);
    EXPECT_GT(triangles.size(), 0.985 * 6000.0);
    EXPECT_GT(area(groom, triangles), 0.96);
    EXPECT_EQ(triangulateRoots(groom, nullptr), triangles);
}

// Roots on the inside of a bowl. The bowl's mesh or the roots' normals show this.
TEST(TriangulateRoots, TurnsToTheSideOfTheNormals) {
    Mesh bowl = makeCap();
    for (auto& triangle : bowl.triangles) std::swap(triangle[1], triangle[2]);
    for (glm::vec3& normal : bowl.normals) normal = -normal;
    Groom groom = rooted(onSphere(200, 0.2));
    for (const Triangle& triangle : triangulateRoots(groom, &bowl))
        EXPECT_LT(glm::dot(areaVector(groom, triangle), cornersOf(groom, triangle)[0]), 0.0);
    for (std::uint32_t i = 0; i < groom.strand_count; ++i)
        groom.root_normals.push_back(-glm::normalize(groom.strand(i)[0]));
    for (const Triangle& triangle : triangulateRoots(groom, nullptr))
        EXPECT_LT(glm::dot(areaVector(groom, triangle), cornersOf(groom, triangle)[0]), 0.0);
}

// The cap's normals are exact at its vertices. Between them they turn by at most 4.3 degrees along
// a ring's triangle. The error of linear interpolation is an eighth of the arc's square.
TEST(RootNormals, AreThoseOfTheSphere) {
    const Mesh cap = makeCap();
    const Groom groom = rooted(onSphere(500, 0.0));
    const auto normals = rootNormals(groom, cap);
    ASSERT_EQ(normals.size(), 500u);
    for (std::uint32_t i = 0; i < 500; ++i) {
        EXPECT_NEAR(glm::length(normals[i]), 1.0, 1e-6);
        const double off =
            glm::distance(glm::dvec3(normals[i]), glm::normalize(glm::dvec3(groom.strand(i)[0])));
        EXPECT_LT(off, std::pow(2.0 * std::numbers::pi / 48.0, 2.0) / 8.0 + 1e-3);
    }
}

TEST(RootNormals, TakeACornersWhereTheSumVanishes) {
    Mesh fold = makeGrid(1, 1, [](std::uint32_t, std::uint32_t) { return false; });
    fold.normals = {{0, 1, 0}, {0, 1, 0}, {0, -1, 0}, {0, -1, 0}};
    const auto normals = rootNormals(rooted({{0, 0, 0.5}}), fold);
    EXPECT_NEAR(glm::length(normals[0]), 1.0, 1e-6);
}

}  // namespace
}  // namespace hair::groom
