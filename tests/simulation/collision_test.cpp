#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hair/reference/constraints.h"
#include "tests/simulation/strands.h"

namespace hair::simulation {
namespace {

const Collider kCapsule{.a = {0, 0, 0}, .b = {0, 2, 0}, .radius = 0.5f};

// Returns the place to which a vertex is pushed. Without `before` it has not moved.
glm::dvec3 pushed(
    const glm::dvec3& point, std::vector<Collider> colliders, std::optional<glm::dvec3> before = {},
    const CollisionSettings& collision = {}) {
    SimulationSettings settings;
    settings.colliders = std::move(colliders);
    settings.collision = collision;
    return reference::Contact{settings, {}, {}}(point, before.value_or(point)).position;
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

// From a capsule's axis along y: its x and z components are equally small, x comes first, and y X x
// = -z. From a sphere's centre: +y.
TEST(Collision, LeavesTheAxisSidewaysInAFixedDirection) {
    expectPoint(pushed({0, 1, 0}, {kCapsule}), {0, 1, -0.5});
    expectPoint(pushed({1, 1, 1}, {{.a = {1, 1, 1}, .b = {1, 1, 1}, .radius = 0.5f}}), {1, 1.5, 1});
}

// The first capsule pushes the vertex into the second, which pushes it farther. In the other order
// the second does nothing.
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

// The vertex is 0.25 deep and has moved 0.2 along the axis. A friction coefficient of 0.5 takes
// back 0.125 of that; 0.8 and more take back all of it, and never more.
TEST(Collision, TakesBackWhatFrictionHolds) {
    const glm::dvec3 before{0.25, 0.8, 0};
    expectPoint(pushed({0.25, 1, 0}, {kCapsule}, before, {.friction = 0.0f}), {0.5, 1, 0});
    const glm::dvec3 slower = pushed({0.25, 1, 0}, {kCapsule}, before, {.friction = 0.5f});
    EXPECT_NEAR(glm::distance(slower, {0.5, 0.875, 0}), 0.0, 1e-15);  // 0.5 * 0.25 back
    expectPoint(pushed({0.25, 1, 0}, {kCapsule}, before, {.friction = 1.0f}), {0.5, 0.8, 0});
    expectPoint(pushed({0.25, 1, 0}, {kCapsule}, before, {.friction = 9.0f}), {0.5, 0.8, 0});
}

// The vertex meets a sphere of radius 0.5 at (-0.4, 0.3), where the normal is (-0.8, 0.6). The end
// of its path, (2, 0.3), lies 1.92 behind the tangent plane there.
TEST(Collision, StopsAtThePlaneWhereItEnters) {
    const Collider ball{.a = {0, 0, 0}, .b = {0, 0, 0}, .radius = 0.5f};
    const glm::dvec3 before{-2, 0.3, 0};
    const CollisionSettings continuous{.continuous = true};
    const glm::dvec3 stopped = pushed({2, 0.3, 0}, {ball}, before, continuous);
    EXPECT_LT(glm::distance(stopped, {2 - 1.92 * 0.8, 0.3 + 1.92 * 0.6, 0}), 1e-12);
    // A vertex that ends inside is moved to the plane at its point of entry too, and not out at the
    // nearest side.
    EXPECT_LT(pushed({0.4, 0.3, 0}, {ball}, before, continuous).x, 0.0);
    EXPECT_GT(pushed({0.4, 0.3, 0}, {ball}, before).x, 0.0) << "but where ways don't count";
    expectPoint(pushed({2, 0.6, 0}, {ball}, glm::dvec3(-2, 0.6, 0), continuous), {2, 0.6, 0});
    expectPoint(pushed({-0.6, 0.3, 0}, {ball}, before, continuous), {-0.6, 0.3, 0});
}

}  // namespace
}  // namespace hair::simulation
