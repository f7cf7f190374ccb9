#include <functional>

#include <gtest/gtest.h>

#include "engine/error.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/simulation/closed_meshes.h"
#include "tests/simulation/gpu_simulation.h"
#include "tests/simulation/motions.h"
#include "tests/simulation/pulls.h"
#include "tests/simulation/rounding.h"

// Tests Simulation::carryOn: wind, colliders, motion and pulls change during a simulation.
namespace hair::simulation {
namespace {

SimulationSettings plain(Solver solver) {
    SimulationSettings settings;
    settings.solver = solver;
    settings.collision = {.margin = 0.002f, .friction = 0.3f};
    return settings;
}

// Returns settings with everything on that carryOn can change.
SimulationSettings busy(Solver solver) {
    SimulationSettings settings = plain(solver);
    settings.wind = {.mode = WindMode::drag, .speed = 5.0f, .turbulence = 0.5f};
    settings.colliders = {{.a = {0, 0, 0}, .b = {0, 0.05f, 0}, .radius = 0.06f}};
    settings.motion = nodding();
    settings.pulls = manyPulls();
    return settings;
}

// Changes that lead from plain() to busy(), one part each.
using Change = std::function<void(SimulationSettings&, const SimulationSettings&)>;
const Change kChanges[] = {
    [](SimulationSettings& s, const SimulationSettings& other) { s.wind = other.wind; },
    [](SimulationSettings& s, const SimulationSettings& other) { s.colliders = other.colliders; },
    [](SimulationSettings& s, const SimulationSettings& other) { s.motion = other.motion; },
    [](SimulationSettings& s, const SimulationSettings& other) { s.pulls = other.pulls; }};

using CarryOn = GpuTest;

TEST_F(CarryOn, WithTheSameSettingsChangesNothing) {
    const groom::Groom groom = wavyGroom(9, 8);
    for (const Solver solver : kSolvers)
        for (const SimulationSettings& settings : {plain(solver), busy(solver)}) {
            Simulation straight(device(), groom, settings, 3);
            Simulation stopped(device(), groom, settings, 3);
            advance(device(), straight, 20);
            for (int i = 0; i < 4; ++i) {
                advance(device(), stopped, 5);
                stopped.carryOn(settings);
            }
            EXPECT_EQ(straight.readPositions(), stopped.readPositions());
            EXPECT_EQ(straight.readPrevious(), stopped.readPrevious());
            EXPECT_EQ(straight.readContacts(), stopped.readContacts());
            EXPECT_EQ(straight.time(), stopped.time());
        }
}

// A simulation takes 7 steps with other settings and then carries on with new ones. Another is made
// with the new settings and set to the same state at the same time. Both continue alike, for every
// change and its reverse. On a CPU they are equal to the bit; a GPU's compiler rounds differently
// in shaders that handle bodies, even if there are none.
TEST_F(CarryOn, GoesOnLikeANewSimulationInItsState) {
    const groom::Groom groom = wavyGroom(9, 8);
    const auto expectAlike = [&](const std::vector<glm::vec3>& found,
                                 const std::vector<glm::vec3>& expected,
                                 const SimulationSettings& settings) {
        if (device().info().type == engine::DeviceType::cpu)
            EXPECT_EQ(found, expected);
        else
            EXPECT_LT(
                largestDifference(found, expected),
                2.0 * roundingAfter(10, groom, settings, 3).bound());
    };
    for (const Solver solver : kSolversOfPositions)
        for (const Change& change : kChanges)
            for (const auto& [from, to] :
                 {std::pair{plain(solver), busy(solver)}, std::pair{busy(solver), plain(solver)}}) {
                SimulationSettings settings = from;
                change(settings, to);
                Simulation carried_on(device(), groom, from, 3);
                advance(device(), carried_on, 7);
                carried_on.carryOn(settings);
                Simulation fresh(device(), groom, settings, 3);
                advance(device(), fresh, 7);
                fresh.setState(carried_on.readPositions(), carried_on.readPrevious());
                Simulation unchanged(device(), groom, from, 3);
                advance(device(), unchanged, 7);
                ASSERT_EQ(carried_on.readPositions(), unchanged.readPositions());
                advance(device(), carried_on, 10);
                advance(device(), fresh, 10);
                advance(device(), unchanged, 10);
                expectAlike(carried_on.readPositions(), fresh.readPositions(), settings);
                expectAlike(carried_on.readPrevious(), fresh.readPrevious(), settings);
                EXPECT_NE(carried_on.readPositions(), unchanged.readPositions());
            }
}

// Rods have velocities beside positions. The change of wind must take effect, and the next step
// must start from the present velocities.
TEST_F(CarryOn, KeepsTheRodsVelocities) {
    const groom::Groom groom = wavyGroom(9, 8);
    const SimulationSettings settings = plain(Solver::rod);
    SimulationSettings windy = settings;
    windy.wind.strength = 1e-30f;  // adds nothing that a float could hold
    Simulation straight(device(), groom, settings, 3);
    Simulation carried_on(device(), groom, settings, 3);
    advance(device(), straight, 20);
    advance(device(), carried_on, 10);
    carried_on.carryOn(windy);
    advance(device(), carried_on, 10);
    EXPECT_EQ(carried_on.readPositions(), straight.readPositions());
    windy.wind.strength = 15.0f;
    carried_on.carryOn(windy);
    advance(device(), carried_on, 1);
    advance(device(), straight, 1);
    EXPECT_NE(carried_on.readPositions(), straight.readPositions());
}

// The field is baked once and stays in use beside new capsules.
TEST_F(CarryOn, KeepsDistanceFields) {
    const groom::Groom groom = straightGroom(3, 8);
    const std::vector<groom::Mesh> meshes{makeSphere({0.05, -0.1, 0.02}, 0.05, 2)};
    SimulationSettings settings = plain(Solver::shape);
    settings.distance_fields = {{.resolution = 16}};
    SimulationSettings both = settings;
    both.colliders = {{.a = {0, -0.1f, 0}, .b = {0, -0.1f, 0.01f}, .radius = 0.03f}};
    Simulation carried_on(device(), groom, settings, 3, meshes);
    carried_on.carryOn(both);
    Simulation fresh(device(), groom, both, 3, meshes);
    Simulation capsule(
        device(), groom,
        [&] {
            SimulationSettings alone = both;
            alone.distance_fields.clear();
            return alone;
        }(),
        3);
    for (Simulation* simulation : {&carried_on, &fresh, &capsule})
        advance(device(), *simulation, 10);
    EXPECT_EQ(carried_on.readPositions(), fresh.readPositions());
    EXPECT_NE(carried_on.readPositions(), capsule.readPositions());
}

TEST_F(CarryOn, TakesFrozenHairWithAHeadThatStartsToMove) {
    const groom::Groom groom = wavyGroom(3, 6);
    SimulationSettings settings = plain(Solver::none);
    Simulation simulation(device(), groom, settings, 3);
    EXPECT_FALSE(simulation.moves());
    settings.motion = posed({0, 40, 10}, {0.1f, 0, 0});
    simulation.carryOn(settings);
    EXPECT_TRUE(simulation.moves());
    advance(device(), simulation, 1);
    // Points lie within 1 m, and each is rounded a few times per turn.
    constexpr double kCarried = 20 * 0x1p-24;
    EXPECT_LT(
        largestDifference(simulation.readPositions(), carried(simulation.pose(), groom.points)),
        kCarried);
    // The hair is back at its first place one step after the change.
    settings.motion = {};
    simulation.carryOn(settings);
    advance(device(), simulation, 1);
    EXPECT_LT(largestDifference(simulation.readPositions(), groom.points), kCarried);
}

TEST_F(CarryOn, LeavesTheStateThatResetGoesBackTo) {
    const groom::Groom groom = wavyGroom(5, 8);
    SimulationSettings settings = plain(Solver::shape);
    settings.settle_steps = 5;
    Simulation simulation(device(), groom, settings, 3);
    const auto start = simulation.readPositions();
    advance(device(), simulation, 5);
    SimulationSettings other = busy(Solver::shape);
    other.settle_steps = 5;
    simulation.carryOn(other);
    advance(device(), simulation, 5);
    simulation.reset();
    EXPECT_EQ(simulation.time(), 0.0);
    EXPECT_EQ(simulation.readPositions(), start);
}

TEST_F(CarryOn, ChangesNothingWhereItThrows) {
    const groom::Groom groom = wavyGroom(5, 8);
    const SimulationSettings settings = busy(Solver::shape);
    SimulationSettings still_wind = plain(Solver::shape);
    still_wind.wind = {.strength = 1.0f, .direction = glm::vec3(0.0f)};
    SimulationSettings other_mode = still_wind;
    other_mode.wind = {.mode = WindMode::drag, .direction = glm::vec3(0.0f), .speed = 1.0f};
    SimulationSettings backwards = plain(Solver::shape);
    backwards.motion.keyframes = {{.time = 1.0f}, {.time = 0.0f}};
    SimulationSettings nowhere = plain(Solver::shape);
    nowhere.pulls = {{.guide = 5}};
    Simulation untouched(device(), groom, settings, 3);
    Simulation refused(device(), groom, settings, 3);
    advance(device(), untouched, 5);
    advance(device(), refused, 5);
    for (const SimulationSettings& bad : {still_wind, other_mode, backwards, nowhere}) {
        EXPECT_THROW(refused.carryOn(bad), engine::Error);
        advance(device(), untouched, 5);
        advance(device(), refused, 5);
        EXPECT_EQ(refused.readPositions(), untouched.readPositions());
    }
}

}  // namespace
}  // namespace hair::simulation
