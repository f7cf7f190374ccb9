#include "hair/groom/growth/triangulate.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "hair/groom/growth/roots.h"
#include "tests/groom/surface_meshes.h"
#include "tests/groom/test_meshes.h"

namespace hair::groom {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// The roots are independent, so some are very close together.
std::vector<SurfacePoint> randomRoots(const Scalp& scalp, std::uint32_t count, std::uint32_t seed) {
    std::vector<SurfacePoint> roots;
    for (std::uint32_t i = 0; i < count; ++i) roots.push_back(rootSample(scalp, seed, i));
    return roots;
}

std::vector<SurfacePoint> spreadRoots(const Scalp& scalp, std::uint32_t count, std::uint32_t seed) {
    std::vector<glm::vec3> candidates;
    for (std::uint32_t i = 0; i < 10 * count; ++i)
        candidates.push_back(rootSample(scalp, seed, i).position);
    std::vector<SurfacePoint> roots;
    for (const std::uint32_t i : eliminateSamples(candidates, {}, count, scalp.area()))
        roots.push_back(rootSample(scalp, seed, i));
    return roots;
}

// Euler's formula for a closed surface: V - E + F = 2 and 0, with 3 F = 2 E.
TEST(SurfaceTriangles, CloseASphere) {
    const Scalp scalp = extractScalp(makeSphere(0.1, 24, 12));
    for (const std::uint32_t count : {4u, 5u, 6u, 20u, 100u, 500u}) {
        for (std::uint32_t seed = 0; seed < 3; ++seed) {
            for (const auto& roots :
                 {spreadRoots(scalp, count, seed), randomRoots(scalp, count, seed)}) {
                const Triangles triangles = surfaceTriangles(scalp, roots);
                const Topology topology = topologyOf(triangles);
                EXPECT_TRUE(topology.is_manifold) << count;
                EXPECT_EQ(topology.vertices, count);
                EXPECT_EQ(topology.euler, 2) << count << " " << seed;
                EXPECT_EQ(topology.loops, 0u);
                EXPECT_EQ(triangles.size(), 2 * count - 4);
            }
        }
    }
}

TEST(SurfaceTriangles, CloseATorus) {
    const Scalp scalp = extractScalp(makeTorus(0.1, 0.04, 48, 24));
    for (const std::uint32_t count : {60u, 300u, 1000u}) {
        for (std::uint32_t seed = 0; seed < 3; ++seed) {
            for (const auto& roots :
                 {spreadRoots(scalp, count, seed), randomRoots(scalp, count, seed)}) {
                const Triangles triangles = surfaceTriangles(scalp, roots);
                const Topology topology = topologyOf(triangles);
                EXPECT_TRUE(topology.is_manifold) << count << " " << seed;
                EXPECT_EQ(topology.vertices, count);
                EXPECT_EQ(topology.euler, 0) << count << " " << seed;
                EXPECT_EQ(topology.loops, 0u);
            }
        }
    }
}

// On a sphere the normal is the direction from the middle.
TEST(SurfaceTriangles, FaceOutward) {
    const Scalp scalp = extractScalp(makeSphere(0.1, 24, 12));
    for (const std::uint32_t count : {20u, 1000u}) {
        for (const auto& roots : {spreadRoots(scalp, count, 1), randomRoots(scalp, count, 1)}) {
            for (const auto& [i, j, k] : surfaceTriangles(scalp, roots)) {
                const glm::vec3 a = roots[i].position;
                const glm::vec3 normal = glm::cross(roots[j].position - a, roots[k].position - a);
                EXPECT_GT(glm::dot(normal, roots[i].position), 0.0f);
            }
        }
    }
}

// An equilateral triangle of circumradius R with its corners on a unit sphere has less area than
// the part of the sphere over it by 0.625 R^2 (seen from the middle dA = (1 + R^2 - 1.5 r^2) da,
// the mean of r^2 being R^2 / 4); 2 n of them have R^2 = 4.84 / n. For spread roots, the difference
// is at most twice that.
TEST(SurfaceTriangles, HaveTheAreaOfASphere) {
    const Scalp scalp = extractScalp(makeSphere(1.0, 96, 48));
    const std::uint32_t count = 500;
    const std::vector<SurfacePoint> roots = spreadRoots(scalp, count, 2);
    double area = 0.0;
    for (const auto& [i, j, k] : surfaceTriangles(scalp, roots)) {
        const glm::vec3 a = roots[i].position;
        area += 0.5 * double{glm::length(glm::cross(roots[j].position - a, roots[k].position - a))};
    }
    EXPECT_LT(area, scalp.area());
    EXPECT_GT(area, 4.0 * std::numbers::pi * (1.0 - 2.0 * 3.02 / count));
}

// In the plane the triangles are Delaunay, without those dropped at the boundary: no root lies in
// the circle through another triangle's roots. The determinant of the paraboloid lift tests the
// circles.
TEST(SurfaceTriangles, AreDelaunayInThePlane) {
    const Scalp scalp = extractScalp(makeGrid(4, 3, [](auto, auto) { return false; }));
    const std::vector<SurfacePoint> roots = randomRoots(scalp, 300, 4);
    const Triangles triangles = surfaceTriangles(scalp, roots);
    EXPECT_GT(triangles.size(), 500u);  // 2 n - 2 - h = 598, less h on the hull and the triangles
                                        // that are dropped
    for (const auto& [i, j, k] : triangles) {
        for (std::uint32_t other = 0; other < roots.size(); ++other) {
            if (other == i || other == j || other == k) continue;
            const auto row = [&](std::uint32_t index) {
                const glm::dvec3 d = glm::dvec3(roots[index].position - roots[other].position);
                return glm::dvec3(d.z, d.x, d.x * d.x + d.z * d.z);
            };
            const double inside = glm::dot(row(i), glm::cross(row(j), row(k)));
            EXPECT_LT(inside, 1e-6);  // positions are stored to 2e-7 of 4
        }
    }
}

TEST(SurfaceTriangles, LeaveHolesOpen) {
    const Mesh mesh = makeGrid(
        12, 12, [](std::uint32_t x, std::uint32_t z) { return x > 3 && x < 8 && z > 3 && z < 8; });
    const Scalp scalp = extractScalp(mesh);
    for (std::uint32_t seed = 0; seed < 5; ++seed) {
        const std::vector<SurfacePoint> roots = spreadRoots(scalp, 400, seed);
        const Triangles triangles = surfaceTriangles(scalp, roots);
        const Topology topology = topologyOf(triangles);
        EXPECT_TRUE(topology.is_manifold);
        EXPECT_EQ(topology.vertices, 400u);
        EXPECT_EQ(topology.pieces, 1u);
        EXPECT_EQ(topology.loops, 2u);
        EXPECT_EQ(topology.euler, 0);  // a ring
        for (const auto& [i, j, k] : triangles) {
            const glm::vec3 middle =
                (roots[i].position + roots[j].position + roots[k].position) / 3.0f;
            EXPECT_TRUE(
                middle.x <= 4.0f || middle.x >= 8.0f || middle.z <= 4.0f || middle.z >= 8.0f);
        }
    }
}

// Two sheets that face each other, much closer than neighbouring roots, with the same orientation.
TEST(SurfaceTriangles, JoinNoPieces) {
    Mesh mesh = makeGrid(6, 6, [](auto, auto) { return false; });
    const Mesh lower = mesh;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec3& position : lower.positions)
        mesh.positions.push_back(position - glm::vec3(0.0f, 0.01f, 0.0f));
    for (const glm::vec3& normal : lower.normals) mesh.normals.push_back(normal);
    for (const auto& [a, b, c] : lower.triangles)
        mesh.triangles.push_back({first + a, first + b, first + c});
    mesh.triangle_materials.resize(mesh.triangles.size(), 0);
    const Scalp scalp = extractScalp(mesh);
    const std::vector<SurfacePoint> roots = randomRoots(scalp, 200, 1);
    const Triangles triangles = surfaceTriangles(scalp, roots);
    for (const auto& [a, b, c] : triangles) {
        EXPECT_EQ(roots[a].position.y, roots[b].position.y);
        EXPECT_EQ(roots[a].position.y, roots[c].position.y);
    }
    const Topology topology = topologyOf(triangles);
    EXPECT_TRUE(topology.is_manifold);
    EXPECT_EQ(topology.pieces, 2u);
    EXPECT_EQ(topology.euler, 2);  // two discs
}

TEST(SurfaceTriangles, HoldFewRoots) {
    const Scalp scalp = extractScalp(makeSphere(0.1, 24, 12));
    EXPECT_EQ(surfaceTriangles(scalp, randomRoots(scalp, 1, 1)), (Triangles{{0, 0, 0}}));
    EXPECT_EQ(surfaceTriangles(scalp, randomRoots(scalp, 2, 1)), (Triangles{{0, 1, 1}}));
    const Scalp square = extractScalp(makeGrid(1, 1, [](auto, auto) { return false; }));
    EXPECT_EQ(surfaceTriangles(square, randomRoots(square, 1, 1)), (Triangles{{0, 0, 0}}));
    EXPECT_EQ(surfaceTriangles(square, randomRoots(square, 2, 1)), (Triangles{{0, 1, 1}}));
}

// Three sheets at one edge, and a vertex that two discs share.
TEST(SurfaceTriangles, TakeWhatIsNoManifold) {
    Mesh mesh = makeGrid(2, 2, [](std::uint32_t x, std::uint32_t z) { return x != z; });
    mesh.positions.emplace_back(0.5f, 1.0f, 0.5f);
    mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
    mesh.triangles.push_back({0, 4, 9});
    mesh.triangle_materials.push_back(0);
    const Scalp scalp = extractScalp(mesh);
    const Triangles triangles = surfaceTriangles(scalp, randomRoots(scalp, 300, 1));
    EXPECT_TRUE(topologyOf(triangles).is_manifold);
    EXPECT_GT(triangles.size(), 400u);
}

}  // namespace
}  // namespace hair::groom
