#include <cstring>

#include <gtest/gtest.h>

#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/simulation/gpu_simulation.h"
#include "tests/simulation/motions.h"
#include "tests/simulation/rounding.h"

// Tests guides on a moving head.
namespace hair::simulation {
namespace {

std::vector<glm::vec3> toFloat(const std::vector<glm::dvec3>& points) {
    return {points.begin(), points.end()};
}

// Capsules that move with the head and one that does not, all in the hair's way.
SimulationSettings withBodies(Solver solver) {
    SimulationSettings settings;
    settings.solver = solver;
    settings.collision = {.margin = 0.002f, .friction = 0.3f};
    settings.colliders = {
        {.a = {0, 0, 0}, .b = {0, 0.05f, 0}, .radius = 0.06f},
        {.a = {0.1f, -0.15f, 0},
         .b = {-0.1f, -0.15f, 0.05f},
         .radius = 0.04f,
         .follows = Follows::world},
        {.a = {0.05f, 0, 0.05f}, .b = {0.05f, 0, 0.05f}, .radius = 0.05f}};
    return settings;
}

using GpuMotion = GpuTest;

// Takes one step from a disturbed state, with head and bodies at 2 m/s and 600 degrees/s. The
// tolerance is that of gpu_constraints_test.cpp, for every substep.
TEST_F(GpuMotion, TakesAStepLikeTheReference) {
    for (const Solver solver : kSolversOfPositions)
        for (const StiffnessScaling scaling :
             {StiffnessScaling::thesis, StiffnessScaling::invariant})
            for (const std::uint32_t substeps : {1u, 2u, 5u})
                for (const std::uint32_t vertices : {2u, 8u, 9u, 64u}) {
                    const groom::Groom groom = wavyGroom(33, vertices);
                    SimulationSettings settings = withBodies(solver);
                    settings.stiffness_scaling = scaling;
                    settings.substeps = substeps;
                    settings.local.stiffness = 0.3f;
                    settings.wind.strength = 10.0f;
                    settings.motion = jerk();
                    Simulation simulation(device(), groom, settings, 5);
                    reference::Reference solution(groom, settings, 5);
                    const RigidMotion start = simulation.pose();
                    const double amount = 0.3 * kReferenceSegment;
                    const auto positions = toFloat(carried(start, disturbed(groom, amount, 11)));
                    const auto previous = toFloat(carried(start, disturbed(groom, amount, 12)));
                    simulation.setState(positions, previous);
                    solution.setState(toDouble(positions), toDouble(previous));
                    advance(device(), simulation, 1);
                    solution.step();
                    const double tolerance = substeps * 1e-5 * longestStrand(groom);
                    EXPECT_LT(
                        largestDifference(simulation.readPositions(), solution.positions()),
                        tolerance)
                        << vertices << " vertices, " << substeps << " substeps";
                    EXPECT_LT(
                        largestDifference(simulation.readPrevious(), solution.previous()),
                        tolerance)
                        << vertices << " vertices, " << substeps << " substeps";
                }
}

TEST_F(GpuMotion, StaysNearTheReferenceForAHundredSteps) {
    for (const Solver solver : kSolversOfPositions)
        for (const std::uint32_t substeps : {1u, 2u, 5u})
            for (const std::uint32_t vertices : {2u, 8u, 9u}) {
                const groom::Groom groom = wavyGroom(5, vertices);
                SimulationSettings settings = withBodies(solver);
                settings.substeps = substeps;
                settings.motion = nodding();
                Simulation simulation(device(), groom, settings, 3);
                reference::Reference solution(groom, settings, 3);
                advance(device(), simulation, 100);
                for (int i = 0; i < 100; ++i) solution.step();
                const Rounding rounding = roundingAfter(100, groom, settings, 3);
                // Every substep rounds.
                EXPECT_LT(
                    largestDifference(simulation.readPositions(), solution.positions()),
                    std::sqrt(substeps) * rounding.bound())
                    << vertices << " vertices, " << substeps << " substeps";
                EXPECT_LT(rounding.spread, 1e-3 * longestStrand(groom))
                    << vertices << " vertices, " << substeps << " substeps";
            }
}

TEST_F(GpuMotion, GivesTheSameBitsAgainAfterReset) {
    const groom::Groom groom = wavyGroom(37, 9);
    SimulationSettings settings = withBodies(Solver::shape);
    settings.motion = nodding();
    settings.settle_steps = 10;
    Simulation simulation(device(), groom, settings, 3);
    const auto start = simulation.readPositions();
    advance(device(), simulation, 20);
    const auto end = simulation.readPositions();
    simulation.reset();
    EXPECT_EQ(simulation.readPositions(), start);
    advance(device(), simulation, 20);
    EXPECT_EQ(simulation.readPositions(), end);
}

// The hair starts on the head's first keyframe and hangs from it as gravity acts there.
TEST_F(GpuMotion, StartsAndSettlesInTheFirstPose) {
    const groom::Groom groom = wavyGroom(5, 8);
    SimulationSettings settings = withBodies(Solver::shape);
    settings.motion = nodding();
    const Simulation unsettled(device(), groom, settings, 3);
    // A rotation and a translation of points within 0.3 m take some five roundings.
    const auto expected = carried(HeadMotion(settings.motion).at(0.0), groom.points);
    EXPECT_LT(largestDifference(unsettled.readPositions(), expected), 5 * 0.3 * 0x1p-24);

    settings.settle_steps = 50;
    const Simulation settled(device(), groom, settings, 3);
    settings.settle_steps = 0;
    settings.motion.keyframes.resize(1);
    Simulation still(device(), groom, settings, 3);
    advance(device(), still, 50);
    EXPECT_EQ(settled.readPositions(), still.readPositions());
}

// Points lie within 1 m, and each is rounded a few times per pull, sweep and turn.
constexpr double kCarried = 20 * 0x1p-24;

TEST_F(GpuMotion, CarriesFrozenHairWithTheHead) {
    const groom::Groom groom = wavyGroom(9, 16);
    SimulationSettings settings;
    settings.global.stiffness = 1.0f;
    settings.motion = nodding();
    Simulation simulation(device(), groom, settings, 3);
    for (int i = 0; i < 60; ++i) {
        advance(device(), simulation, 1);
        ASSERT_LT(
            largestDifference(simulation.readPositions(), carried(simulation.pose(), groom.points)),
            kCarried);
    }
}

TEST_F(GpuMotion, NoneIsCarriedWithTheHead) {
    const groom::Groom groom = wavyGroom(9, 16);
    SimulationSettings settings;
    settings.solver = Solver::none;
    settings.settle_steps = 3;
    settings.motion = nodding();
    Simulation simulation(device(), groom, settings, 3);
    EXPECT_TRUE(simulation.moves());
    for (int i = 1; i <= 60; ++i) {
        const auto before = simulation.readPositions();
        advance(device(), simulation, 1);
        EXPECT_DOUBLE_EQ(simulation.time(), i * double{settings.time_step});
        ASSERT_LT(
            largestDifference(simulation.readPositions(), carried(simulation.pose(), groom.points)),
            kCarried);
        ASSERT_EQ(simulation.readPrevious(), before);
    }
    settings.motion = {};
    EXPECT_FALSE(Simulation(device(), groom, settings, 3).moves());
}

// Returns v after a turn of 120 degrees about (1, 1, 1), which maps axes to axes exactly.
glm::vec3 axesTurned(const glm::vec3& v) { return {v.z, v.x, v.y}; }

// Physics has no preferred direction: on a turned head, under gravity that is turned alike, hair
// moves the same way. This is in double precision, with a turn that maps gravity's floats to
// floats.
TEST(ReferenceMotion, DoesTheSameInAnyPose) {
    for (const Solver solver : kSolvers) {
        const groom::Groom groom = wavyGroom(5, 9);
        SimulationSettings settings = withBodies(solver);
        settings.colliders[1].follows = Follows::head;
        settings.gravity = {1, -9, 3};
        reference::Reference upright(groom, settings, 3);
        settings.motion = posed({0, 90, 90}, {0.3f, 0.1f, -0.2f});
        settings.gravity = axesTurned(settings.gravity);
        const RigidMotion pose = HeadMotion(settings.motion).at(0.0);
        ASSERT_LT(glm::distance(pose.rotation * glm::dvec3(1, 2, 3), {3, 1, 2}), 1e-14);
        reference::Reference turned(groom, settings, 3);
        for (int i = 0; i < 100; ++i) {
            upright.step();
            turned.step();
        }
        std::vector<glm::dvec3> expected;
        for (const glm::dvec3& point : upright.positions()) expected.push_back(pose(point));
        // Double rounds to 2^-53, against 2^-24 on the device, where rounding spreads to less than
        // 1e-4 m. Hair that few corrections leave limp spreads it ten times as far.
        const double spread = solver == Solver::position_based_rod ? 1e-11 : 1e-12;
        EXPECT_LT(largestDifference(turned.positions(), expected), spread);
    }
}

TEST_F(GpuMotion, DoesTheSameInAnyPose) {
    for (const Solver solver : kSolversOfPositions) {
        const groom::Groom groom = wavyGroom(5, 9);
        SimulationSettings settings = withBodies(solver);
        settings.colliders[1].follows = Follows::head;
        Simulation upright(device(), groom, settings, 3);
        const Rounding rounding = roundingAfter(100, groom, settings, 3);
        settings.motion = posed({25, -130, 70}, {0.3f, 0.1f, -0.2f});
        const RigidMotion pose = HeadMotion(settings.motion).at(0.0);
        settings.gravity = pose.rotation * glm::dvec3(settings.gravity);
        Simulation turned(device(), groom, settings, 3);
        advance(device(), upright, 100);
        advance(device(), turned, 100);
        // Both simulations round; the simulation away from the origin rounds by twice as much.
        // Turned gravity is rounded by 6e-7 m/s^2, which makes 8e-7 m in 100 steps.
        EXPECT_LT(
            largestDifference(turned.readPositions(), carried(pose, upright.readPositions())),
            3.0 * rounding.bound() + 8e-7);
    }
}

// A strand with a root segment without length takes its first frame from the head, too.
TEST_F(GpuMotion, TurnsStrandsWithoutARootSegment) {
    groom::Groom groom{.strand_count = 1, .vertices_per_strand = 4};
    groom.points = {{0, 0, 0}, {0, 0, 0}, {0.02f, 0, 0}, {0.03f, 0.02f, 0}};
    SimulationSettings settings = nothingActs();
    settings.local = {.stiffness = 0.5f, .iterations = 10};
    settings.motion = posed({0, 0, 90}, {});
    const auto expected = carried(HeadMotion(settings.motion).at(0.0), groom.points);
    Simulation simulation(device(), groom, settings, 3);
    reference::Reference solution(groom, settings, 3);
    advance(device(), simulation, 10);
    for (int i = 0; i < 10; ++i) solution.step();
    EXPECT_LT(largestDifference(solution.positions(), expected), 1e-14);
    EXPECT_LT(largestDifference(simulation.readPositions(), expected), 1e-7);
}

// The head carries a strand through a fixed sphere: the sphere stays, and the strand leaves it. If
// lengths are enforced last, hair presses into the margin.
TEST_F(GpuMotion, LeavesTheWorldsBodiesWhereTheyAre) {
    const groom::Groom groom = straightGroom(3, 8);
    for (const LengthMethod method : {LengthMethod::tridiagonal, LengthMethod::iterate}) {
        SimulationSettings settings;
        settings.length.method = method;
        settings.collision.margin = 0.002f;
        const glm::vec3 centre{0.05f, -0.1f, 0.2f};
        settings.colliders = {
            {.a = centre, .b = centre, .radius = 0.05f, .follows = Follows::world}};
        settings.motion.keyframes = {{.time = 0.0f}, {.time = 0.5f, .translation = {0, 0, 0.25f}}};
        Extremes distances;
        Simulation simulation(device(), groom, settings, 3);
        for (int i = 0; i < 60; ++i) {
            advance(device(), simulation, 1);
            const auto points = simulation.readPositions();
            for (std::size_t v = 0; v < points.size(); ++v)
                if (v % 8 != 0) distances.add(double{glm::distance(points[v], centre)});
        }
        const double surface = method == LengthMethod::iterate ? 0.052 : 0.05;
        EXPECT_GT(distances.least(), surface - 1e-7);  // two roundings of points 0.5 m away
        EXPECT_LT(distances.least(), 0.052 + 1e-7);  // they did meet
    }
}

}  // namespace
}  // namespace hair::simulation
