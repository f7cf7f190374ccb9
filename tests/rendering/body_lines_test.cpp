#include "hair/rendering/renderer.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/largest_difference.h"

namespace hair::rendering {
namespace {

float distanceToAxis(const glm::vec3& p, const Collider& c) {
    const glm::vec3 axis = c.b - c.a;
    const float size = glm::dot(axis, axis);
    const float t = size > 0.0f ? std::clamp(glm::dot(p - c.a, axis) / size, 0.0f, 1.0f) : 0.0f;
    return glm::distance(p, c.a + t * axis);
}

TEST(BodyLines, LieOnTheCapsuleAndReachItsEnds) {
    const Collider capsule{.a = {0.1f, 0.2f, 0.0f}, .b = {0.3f, -0.1f, 0.2f}, .radius = 0.05f};
    const glm::vec3 axis = glm::normalize(capsule.b - capsule.a);
    Extremes from_a;
    Extremes from_b;
    for (const gpu::BodyLine& line : capsuleLines(capsule)) {
        EXPECT_EQ(line.moves, 1u);
        for (const glm::vec3& end : {line.from, line.to}) {
            EXPECT_NEAR(distanceToAxis(end, capsule), 0.05f, 1e-6f);
            from_a.add(double{glm::dot(end - capsule.a, axis)});
            from_b.add(double{glm::dot(end - capsule.b, axis)});
        }
    }
    EXPECT_NEAR(from_a.least(), -0.05, 1e-6);
    EXPECT_NEAR(from_b.greatest(), 0.05, 1e-6);
}

TEST(BodyLines, ASphereHasThreeGreatCircles) {
    const Collider sphere{
        .a = {1, 2, 3}, .b = {1, 2, 3}, .radius = 0.5f, .follows = Follows::world};
    const auto lines = capsuleLines(sphere);
    EXPECT_EQ(lines.size(), 3u * 32u);
    for (const gpu::BodyLine& line : lines) {
        EXPECT_EQ(line.moves, 0u);
        EXPECT_NEAR(glm::distance(line.from, sphere.a), 0.5f, 1e-6f);
    }
}

// A tetrahedron has six edges, each of two triangles.
TEST(BodyLines, AMeshHasEachEdgeOnce) {
    const groom::Mesh tetrahedron{
        .positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        .triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
    EXPECT_EQ(meshLines(tetrahedron, Follows::head).size(), 6u);
    const SimulationSettings settings{
        .colliders = {{.a = {0, 0, 0}, .b = {0, 0, 0}}}, .distance_fields = {{}}};
    EXPECT_EQ(bodyLines(settings, std::vector{tetrahedron}).size(), 3u * 32u + 6u);
}

}  // namespace
}  // namespace hair::rendering
