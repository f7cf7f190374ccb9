#include <cmath>

#include <gtest/gtest.h>

#include "hair/reference/constraints.h"
#include "tests/simulation/strands.h"

namespace hair::simulation {
namespace {

const Collider kCapsule{.a = {0, 0, 0}, .b = {0, 2, 0}, .radius = 0.5f};

// The strand has its root far away; its second vertex is the one that is pushed.
glm::dvec3 pushed(
    const glm::dvec3& point, std::vector<Collider> colliders, const glm::dvec3& before = {},
    const CollisionSettings& settings = {}) {
    std::vector<glm::dvec3> points{{100, 0, 0}, point};
    const std::vector<glm::dvec3> old{{100, 0, 0}, before};
    reference::pushOut(points, old, colliders, settings);
    EXPECT_EQ(points[0], glm::dvec3(100, 0, 0));
    return points[1];
}

void expectPoint(const glm::dvec3& point, const glm::dvec3& expected) {
    EXPECT_LT(glm::distance(point, expected), 1e-15) << point.x << " " << point.y << " " << point.z;
}

TEST(Collision, LeavesVerticesOutsideAlone) {
    expectPoint(pushed({0.6, 1, 0}, {kCapsule}), {0.6, 1, 0});
    expectPoint(pushed({0.4, 2.4, 0}, {kCapsule}), {0.4, 2.4, 0});  // beside the cap
}

TEST(Collision, PushesOutSidewaysAndThroughTheCaps) {
    expectPoint(pushed({0.25, 1, 0}, {kCapsule}), {0.5, 1, 0});
    expectPoint(pushed({0, 2.25, 0}, {kCapsule}), {0, 2.5, 0});
    expectPoint(pushed({0.15, -0.2, 0}, {kCapsule}), {0.3, -0.4, 0});
}

TEST(Collision, TreatsEqualEndsAsASphere) {
    expectPoint(
        pushed({1.1, 1, 1}, {{.a = {1, 1, 1}, .b = {1, 1, 1}, .radius = 0.5f}}), {1.5, 1, 1});
}

// From the axis: along y, x and z tie for what it has least of, x comes first, and y X x = -z.
// From a sphere's middle: +y.
TEST(Collision, LeavesTheAxisSidewaysInAFixedDirection) {
    expectPoint(pushed({0, 1, 0}, {kCapsule}), {0, 1, -0.5});
    expectPoint(pushed({1, 1, 1}, {{.a = {1, 1, 1}, .b = {1, 1, 1}, .radius = 0.5f}}), {1, 1.5, 1});
}

// The first capsule pushes into the second, which pushes on; in the other order the second does
// nothing.
TEST(Collision, GoesThroughTheListInOrder) {
    const Collider left{.a = {0, 0, 0}, .b = {0, 0, 0}, .radius = 1.0f};
    const Collider right{.a = {1.5, 0, 0}, .b = {1.5, 0, 0}, .radius = 1.0f};
    expectPoint(pushed({0.25, 0, 0}, {left, right}), {0.5, 0, 0});
    expectPoint(pushed({0.25, 0, 0}, {right, left}), {1, 0, 0});
}

TEST(Collision, KeepsTheMargin) {
    expectPoint(pushed({0.25, 1, 0}, {kCapsule}, {}, {.margin = 0.25f}), {0.75, 1, 0});
    expectPoint(pushed({0.6, 1, 0}, {kCapsule}, {}, {.margin = 0.25f}), {0.75, 1, 0});
    expectPoint(pushed({0.8, 1, 0}, {kCapsule}, {}, {.margin = 0.25f}), {0.8, 1, 0});
}

// 0.25 deep and 0.2 moved along the axis: a coefficient of 0.5 takes 0.125 of it back, one of 0.8
// and above all of it, and never more.
TEST(Collision, TakesBackWhatFrictionHolds) {
    const glm::dvec3 before{0.25, 0.8, 0};
    expectPoint(pushed({0.25, 1, 0}, {kCapsule}, before, {.friction = 0.0f}), {0.5, 1, 0});
    const glm::dvec3 slower = pushed({0.25, 1, 0}, {kCapsule}, before, {.friction = 0.5f});
    EXPECT_NEAR(glm::distance(slower, {0.5, 0.875, 0}), 0.0, 1e-15);  // 0.5 * 0.25 back
    expectPoint(pushed({0.25, 1, 0}, {kCapsule}, before, {.friction = 1.0f}), {0.5, 0.8, 0});
    expectPoint(pushed({0.25, 1, 0}, {kCapsule}, before, {.friction = 9.0f}), {0.5, 0.8, 0});
}

TEST(Collision, LeavesARootInsideAlone) {
    std::vector<glm::dvec3> points{{0.1, 1, 0}, {0.1, 1.1, 0}};
    reference::pushOut(points, points, std::span(&kCapsule, 1), {});
    EXPECT_EQ(points[0], glm::dvec3(0.1, 1, 0));
    EXPECT_NEAR(points[1].x, 0.5, 1e-15);
}

}  // namespace
}  // namespace hair::simulation
