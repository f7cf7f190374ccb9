#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/error.h"
#include "hair/reference/solvers.h"
#include "hair/simulation/forces.h"
#include "tests/simulation/pulls.h"

// Tests hands and their pulls in the reference.
namespace hair::simulation {
namespace {

constexpr double kPullRounding = 1e-12;  // rounding of double
constexpr double kPullStep = 0.0625;  // s, exact in float

void expectHand(
    const std::optional<Hand>& hand, const glm::dvec3& position, const glm::dvec3& velocity) {
    ASSERT_TRUE(hand);
    EXPECT_LT(glm::distance(hand->position, position), kPullRounding);
    EXPECT_LT(glm::distance(hand->velocity, velocity), kPullRounding);
}

TEST(Hand, GoesStraightBetweenItsKeys) {
    const PullSettings pull{
        .path = {
            {.time = 1.0f, .position = {0, 0, 0}},
            {.time = 2.0f, .position = {4, 0, 0}},
            {.time = 4.0f, .position = {4, 2, 0}}}};
    expectHand(handIn(pull, 1.25, 1.5), {2, 0, 0}, {4, 0, 0});
    expectHand(handIn(pull, 2.0, 3.0), {4, 1, 0}, {0, 1, 0});
    // Round the corner the velocity is the mean of half a step at each speed.
    expectHand(handIn(pull, 1.75, 2.25), {4, 0.25, 0}, {2, 0.5, 0});
    // The hand stands still before its first key and after its last.
    expectHand(handIn(pull, 0.75, 1.5), {2, 0, 0}, {2.0 / 0.75, 0, 0});
    expectHand(handIn(pull, 3.5, 4.25), {4, 2, 0}, {0, 0.5 / 0.75, 0});
    expectHand(handIn(pull, 0.0, 8.0), {4, 2, 0}, {0.5, 0.25, 0});
}

TEST(Hand, PullsInStepsWhoseMiddleIsInItsTime) {
    const PullSettings pull{.path = {{.time = 1.0f}, {.time = 2.0f}}};
    EXPECT_FALSE(handIn(pull, 0.5, 1.0));
    EXPECT_FALSE(handIn(pull, 0.75, 1.125));
    EXPECT_TRUE(handIn(pull, 0.875, 1.25));
    EXPECT_TRUE(handIn(pull, 1.875, 2.0));
    EXPECT_TRUE(handIn(pull, 1.875, 2.0625));
    EXPECT_FALSE(handIn(pull, 1.875, 2.25));
    EXPECT_FALSE(handIn(pull, 2.0, 2.125));
    EXPECT_FALSE(handIn({.path = {}}, 0.0, 1.0));
}

// The hand pulls in these steps although 1/60 s and its multiples are rounded.
TEST(Hand, PullsInEveryStepFromKeyToKey) {
    const double dt = 1.0f / 60.0f;
    for (int first = 0; first < 600; first += 7) {
        const PullSettings pull{
            .path = {
                {.time = static_cast<float>(first) / 60.0f},
                {.time = static_cast<float>(first + 30) / 60.0f}}};
        for (int step = 0; step < 700; ++step)
            ASSERT_EQ(
                handIn(pull, step * dt, (step + 1) * dt).has_value(),
                step >= first && step < first + 30)
                << first << " " << step;
    }
}

std::string refusal(const PullSettings& pull) {
    try {
        checkPulls(std::vector{PullSettings{}, pull}, 7, 5);
    } catch (const engine::Error& error) {
        return error.what();
    }
    return "";
}

TEST(CheckPulls, NamesWhatIsNotThere) {
    EXPECT_EQ(refusal({.guide = 6, .vertex = 4}), "");
    EXPECT_EQ(
        refusal({.guide = 7}), "/simulation/pulls/1/guide: 7 is too large: the groom has 7 guides");
    EXPECT_EQ(
        refusal({.vertex = 5}),
        "/simulation/pulls/1/vertex: 5 is too large: the groom has 5 vertices per guide");
    EXPECT_EQ(
        refusal({.path = {{.time = 1.0f}, {.time = 2.0f}, {.time = 2.0f}}}),
        "/simulation/pulls/1/path/2/time: is not after the previous key");
}

// A free vertex follows a hand that moves at constant speed.
TEST(ReferencePull, ApproachesTheHandAsCriticallyDamped) {
    const groom::Groom groom = straightGroom(1, 2);
    for (const float stiffness : {25.0f, 400.0f, 1e5f})
        for (const float step : {0.0005f, static_cast<float>(kPullStep), 0.1f}) {
            const double dt = step;
            const glm::dvec3 away(0.3, -0.2, 0.1);
            const glm::dvec3 velocity(0.5, 0.25, -1.0);
            const glm::dvec3 start = groom.points[1];
            SimulationSettings settings = nothingActs();
            settings.time_step = step;
            settings.pulls = {
                {.stiffness = stiffness, .path = goes(glm::vec3(start - away), velocity)}};
            reference::Reference solver(groom, settings, 1);
            solver.setState(
                std::vector{glm::dvec3(groom.points[0]), start},
                std::vector{glm::dvec3(groom.points[0]), start - dt * velocity});
            const glm::dvec3 hand = settings.pulls[0].path[0].position;
            const double speed_error = 1e-6;  // of the hand's float key 16 s away, in m
            for (int n = 1; n <= 50; ++n) {
                solver.step();
                const glm::dvec3 expected =
                    hand + n * dt * velocity + approach(n, stiffness, dt) * (start - hand);
                ASSERT_LT(glm::distance(solver.positions()[1], expected), speed_error)
                    << stiffness << " " << step << " " << n;
            }
        }
}

// A vertex on a spring hangs g / k lower than without weight, at any time step.
TEST(ReferencePull, BalancesGravity) {
    const groom::Groom groom = straightGroom(1, 2);
    for (const float step : {0.005f, 0.1f})
        for (const std::uint32_t substeps : {1u, 5u}) {
            SimulationSettings settings = nothingActs();
            settings.gravity = {0, -10, 0};
            settings.time_step = step;
            settings.substeps = substeps;
            settings.pulls = {{.stiffness = 50.0f, .path = stays({0, 1, 0})}};
            reference::Reference solver(groom, settings, 1);
            for (int i = 0; i < 2000; ++i) solver.step();
            EXPECT_LT(glm::distance(solver.positions()[1], {0, 1 - 10.0 / 50.0, 0}), 1e-10);
        }
}

TEST(ReferencePull, LetsHairSettleWithoutHands) {
    const groom::Groom groom = wavyGroom(3, 6);
    SimulationSettings settings;
    reference::Reference alone(groom, settings, 1);
    settings.pulls = manyPulls();
    reference::Reference held(groom, settings, 1);
    for (int i = 0; i < 10; ++i) {
        alone.settle();
        held.settle();
    }
    EXPECT_EQ(largestDifference(alone.positions(), held.positions()), 0.0);
}

}  // namespace
}  // namespace hair::simulation
