#include "hair/simulation/probes.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/gpu_fixture.h"
#include "tests/simulation/gpu_simulation.h"
#include "tests/simulation/strands.h"

namespace hair::simulation {
namespace {

constexpr float kNowhere = std::numeric_limits<float>::infinity();

TEST(GuideCondition, NamesTheWorstGuideAndCountsThoseBeyondTheLimit) {
    const gpu::VertexCondition fine{.stretch = 1.0f, .gap = kNowhere, .moved = 0.0f};
    const std::vector<gpu::VertexCondition> vertices{
        fine,
        {.stretch = 1.06f, .gap = 0.5f, .moved = 0.0f},
        {.stretch = 1.2f, .gap = -0.001f, .moved = 0.01f},
        fine,
        {.stretch = 1.3f, .gap = -0.00005f, .moved = 0.03f},
        {.stretch = 0.5f, .gap = -0.00009f, .moved = 0.0f},
        fine,
        fine,
        {.stretch = 1.049f, .gap = 0.1f, .moved = 0.0009f}};
    const GuideCondition condition = worstOf(vertices, 3, 0.1);
    EXPECT_FLOAT_EQ(static_cast<float>(condition.stretch.value), 1.3f);
    EXPECT_EQ(condition.stretch.guide, 1u);
    EXPECT_EQ(condition.stretch.guides, 2u);
    EXPECT_FLOAT_EQ(static_cast<float>(condition.depth.value), 0.001f);
    EXPECT_EQ(condition.depth.guide, 0u);
    EXPECT_EQ(condition.depth.guides, 1u);
    EXPECT_FLOAT_EQ(static_cast<float>(condition.speed.value), 0.3f);
    EXPECT_EQ(condition.speed.guide, 1u);
    EXPECT_EQ(condition.speed.guides, 2u);
}

TEST(GuideCondition, WhatIsNoNumberIsTheWorst) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<gpu::VertexCondition> vertices{
        {.stretch = 9.0f, .gap = -1.0f, .moved = 1.0f},
        {.stretch = nan, .gap = nan, .moved = nan},
        {.stretch = 10.0f, .gap = -2.0f, .moved = 2.0f}};
    const GuideCondition condition = worstOf(vertices, 1, 1.0);
    for (const Worst& worst : {condition.stretch, condition.depth, condition.speed}) {
        EXPECT_TRUE(std::isnan(worst.value));
        EXPECT_EQ(worst.guide, 1u);
        EXPECT_EQ(worst.guides, 3u);
    }
}

TEST(GuideCondition, NothingIsWrongWithHairAtRest) {
    const GuideCondition condition =
        worstOf(std::vector<gpu::VertexCondition>(4, {1.0f, kNowhere, 0.0f}), 2, 1.0);
    EXPECT_EQ(condition.stretch.value, 1.0);
    EXPECT_EQ(condition.depth.value, 0.0);
    EXPECT_EQ(condition.speed.value, 0.0);
    EXPECT_EQ(condition.stretch.guides + condition.depth.guides + condition.speed.guides, 0u);
}

using GuideConditions = GpuTest;

// Tolerances: lengths of 0.1 m are rounded to 1e-8 m; segments are 0.1 m long and steps take 1/60
// s.
TEST_F(GuideConditions, FindsWhatIsWrongOnTheDevice) {
    SimulationSettings settings = nothingActs();
    settings.time_step = 1.0f / 60.0f;
    settings.collision.margin = 0.05f;  // has no effect here
    settings.colliders = {
        {.a = {0.1f, -0.3f, 0.0f}, .b = {0.1f, -0.3f, 0.0f}, .radius = 0.02f},
        {.a = {5.0f, 0.0f, 0.0f}, .b = {5.0f, 1.0f, 0.0f}, .radius = 1.0f}};
    const groom::Groom groom = straightGroom(3, 4, 0.1);
    Simulation simulation(device(), groom, settings, 1);
    std::vector<glm::vec3> points = groom.points;
    points[5].y += 0.03f;  // its own segment is now 0.07 m long, the next one 0.13 m
    std::vector<glm::vec3> before = points;
    before[3].z -= 0.001f;
    simulation.setState(points, before);
    const GuideCondition condition = simulation.condition();
    EXPECT_NEAR(condition.stretch.value, 1.3, 1e-6);
    EXPECT_EQ(condition.stretch.guide, 1u);
    EXPECT_EQ(condition.stretch.guides, 1u);
    // The tip of the third guide, at x = 0.1 m, is the sphere's centre.
    EXPECT_NEAR(condition.depth.value, 0.02, 1e-6);
    EXPECT_EQ(condition.depth.guide, 2u);
    EXPECT_EQ(condition.depth.guides, 1u);
    EXPECT_NEAR(condition.speed.value, 0.06, 1e-5);
    EXPECT_EQ(condition.speed.guide, 0u);
}

// Bodies that follow the head are taken at the head's present pose.
TEST_F(GuideConditions, SeesBodiesWhereTheHeadIs) {
    SimulationSettings settings = nothingActs();
    settings.motion.keyframes = {{.time = 0.0f, .translation = {0.0f, 1.0f, 0.0f}}};
    settings.colliders = {
        {.a = {0.0f, -0.1f, 0.0f}, .b = {0.0f, -0.1f, 0.0f}, .radius = 0.03f},
        {.a = {0.0f, 0.9f, 0.0f},
         .b = {0.0f, 0.9f, 0.0f},
         .radius = 0.02f,
         .follows = Follows::world}};
    const groom::Groom groom = straightGroom(1, 2, 0.1);
    EXPECT_NEAR(Simulation(device(), groom, settings, 1).condition().depth.value, 0.03, 1e-6);
    settings.colliders.erase(settings.colliders.begin());
    EXPECT_NEAR(Simulation(device(), groom, settings, 1).condition().depth.value, 0.02, 1e-6);
}

// Two straight guides along x have segments of 1 m, so that the distance along a guide is the
// vertex's index.
TEST(FindBroken, NamesTheFirstVertexThatNoSimulationMayReach) {
    const std::vector<glm::vec3> rest{{0, 0, 0}, {1, 0, 0}, {2, 0, 0},
                                      {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
    EXPECT_FALSE(findBroken(rest, rest, 3, 1.0));
    std::vector<glm::vec3> positions = rest;
    positions[5] = {3, 1, 0};  // 1 + 2 m from the root, and 2 m at rest
    EXPECT_FALSE(findBroken(positions, rest, 3, 1.5));
    const auto longer = findBroken(positions, rest, 3, 1.49);
    ASSERT_TRUE(longer);
    EXPECT_EQ(longer->guide, 1u);
    EXPECT_EQ(longer->vertex, 2u);
    EXPECT_DOUBLE_EQ(longer->stretch, 1.5);
    for (const float nowhere : {kNowhere, std::numeric_limits<float>::quiet_NaN()}) {
        positions[1].z = nowhere;
        const auto broken = findBroken(positions, rest, 3, 1.49);
        ASSERT_TRUE(broken);
        EXPECT_EQ(broken->guide, 0u);
        EXPECT_EQ(broken->vertex, 1u);
        EXPECT_TRUE(std::isnan(broken->stretch));
    }
}

// The root has no length above it.
TEST(FindBroken, FindsARootWithoutAPosition) {
    const std::vector<glm::vec3> rest{{0, 0, 0}, {1, 0, 0}};
    const auto broken =
        findBroken(std::vector<glm::vec3>{{kNowhere, 0, 0}, {1, 0, 0}}, rest, 2, 2.0);
    ASSERT_TRUE(broken);
    EXPECT_EQ(broken->vertex, 0u);
}

}  // namespace
}  // namespace hair::simulation
