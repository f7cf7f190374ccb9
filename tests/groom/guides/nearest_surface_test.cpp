#include "hair/groom/mesh/surface.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "hair/random.h"
#include "tests/groom/test_meshes.h"
#include "tests/simulation/surface_reference.h"

namespace hair::groom {
namespace {

glm::dvec3 randomPoint(std::uint32_t seed, std::uint32_t index, double size) {
    return size * (glm::dvec3(
                       random01(seed, index, 100), random01(seed, index, 101),
                       random01(seed, index, 102)) -
                   0.5);
}

// Compares with a search through all triangles. The coordinates are below 1, so both round by
// 1e-15.
void expectNearest(const Mesh& mesh, double size, std::uint32_t count) {
    const NearestSurface surface(mesh.positions, mesh.triangles);
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::dvec3 p = randomPoint(7, i, size);
        const MeshPoint at = surface(p);
        EXPECT_NEAR(at.distance, reference::distance(mesh, p), 1e-14);
        EXPECT_NEAR(at.weights.x + at.weights.y + at.weights.z, 1.0, 1e-14);
        glm::dvec3 there(0.0);
        for (int k = 0; k < 3; ++k) {
            EXPECT_GE(at.weights[k], 0.0);
            const auto corners = reference::corners(mesh, mesh.triangles[at.triangle]);
            there += at.weights[k] * corners[static_cast<std::size_t>(k)];
        }
        EXPECT_LT(glm::distance(there, at.position), 1e-14);
        EXPECT_NEAR(glm::distance(there, p), at.distance, 1e-14);
    }
}

TEST(NearestSurface, FindsWhatGoingThroughAllFinds) { expectNearest(makeCap(), 0.4, 500); }

TEST(NearestSurface, FindsItAmongTrianglesInDisorder) {
    Mesh mesh;
    for (std::uint32_t i = 0; i < 300; ++i) {
        const glm::dvec3 centre = randomPoint(1, i, 0.6);
        for (std::uint32_t k = 0; k < 3; ++k)
            mesh.positions.push_back(glm::vec3(centre + randomPoint(2, 3 * i + k, 0.2)));
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    expectNearest(mesh, 1.0, 500);
}

// Needles, triangles that are a line or a point, and many triangles at one place.
TEST(NearestSurface, TakesTrianglesWithoutArea) {
    Mesh mesh;
    const auto add = [&mesh](glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), {a, b, c});
        mesh.triangles.push_back({first, first + 1, first + 2});
    };
    for (int i = 0; i < 40; ++i) add(glm::vec3(0.25f), glm::vec3(0.25f), glm::vec3(0.25f));
    add({-0.5f, 0, 0}, {0.5f, 0, 0}, {0.125f, 0, 0});
    add({0, -0.5f, 0}, {0, -0.5f, 0}, {0, 0.5f, 0});
    add({-0.4f, -0.4f, 0.1f}, {0.4f, 0.3f, 0.1f}, {0.1f, 0.0375f, 0.1f});
    const NearestSurface surface(mesh.positions, mesh.triangles);
    for (std::uint32_t i = 0; i < 500; ++i) {
        const glm::dvec3 p = randomPoint(3, i, 1.0);
        // Distances from the three segments and the point; the needle is 1e-8 wide.
        const auto toSegment = [&](glm::dvec3 a, glm::dvec3 b) {
            const double along =
                std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
            return glm::distance(p, a + along * (b - a));
        };
        const double expected = std::min(
            {glm::distance(p, glm::dvec3(0.25)), toSegment({-0.5, 0, 0}, {0.5, 0, 0}),
             toSegment({0, -0.5, 0}, {0, 0.5, 0}),
             toSegment(glm::vec3(-0.4f, -0.4f, 0.1f), glm::vec3(0.4f, 0.3f, 0.1f))});
        EXPECT_NEAR(surface(p).distance, expected, 2e-8);
    }
}

// Weights tell whether the nearest point lies on a face, an edge or a corner, so they have to be
// exactly 0 or 1 there.
TEST(NearestSurface, TellsFacesEdgesAndCorners) {
    const std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}};
    const NearestSurface surface(positions, triangles);
    EXPECT_EQ(surface({-3, -2, 1}).weights, glm::dvec3(1, 0, 0));
    EXPECT_EQ(surface({5, -1, 1}).weights, glm::dvec3(0, 1, 0));
    EXPECT_EQ(surface({-1, 5, 1}).weights, glm::dvec3(0, 0, 1));
    EXPECT_EQ(surface({0.25, -2, 1}).weights, glm::dvec3(0.75, 0.25, 0));
    EXPECT_EQ(surface({2, 2, 0}).weights, glm::dvec3(0, 0.5, 0.5));
    EXPECT_EQ(surface({0.25, 0.25, -4}).weights, glm::dvec3(0.5, 0.25, 0.25));
    EXPECT_EQ(surface({0.25, 0.25, -4}).distance, 4.0);
}

}  // namespace
}  // namespace hair::groom
