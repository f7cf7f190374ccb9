#include <cstring>

#include <gtest/gtest.h>

#include "hair/reference/solvers.h"
#include "tests/gpu_fixture.h"
#include "tests/simulation/gpu_simulation.h"
#include "tests/simulation/near_reference.h"
#include "tests/simulation/parallelisms.h"
#include "tests/simulation/strands.h"

// Tests the whole solver on the device.
namespace hair::simulation {
namespace {

bool sameBits(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

using GpuSolver = GpuTest;

class GpuShapeSolver : public GpuTest, public testing::WithParamInterface<Parallelism> {
protected:
    static SimulationSettings windy() {
        SimulationSettings settings = simulation::windy();
        settings.parallelism = GetParam();
        return settings;
    }
};

FOR_EVERY_PARALLELISM(GpuShapeSolver);

TEST_F(GpuSolver, FollowsVerletsDiscreteParabola) {
    const groom::Groom groom = straightGroom(3, 4);
    SimulationSettings settings = nothingActs();
    settings.gravity = {0.5f, -9.8f, 0.25f};
    Simulation simulation(device(), groom, settings, 1);
    advance(device(), simulation, 60);
    const double dt = settings.time_step;
    const glm::dvec3 fallen = 60.0 * 61.0 / 2.0 * dt * dt * glm::dvec3(settings.gravity);
    const auto points = simulation.readPositions();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 moved = i % 4 == 0 ? glm::dvec3(0.0) : fallen;
        // Positions up to 5 m are rounded by up to 2.4e-7 m a step. A rounding in step n is
        // velocity for the 60 - n steps after it: 60 * 61 / 2 * 2.4e-7 m at worst, and a tenth of
        // that because roundings are random.
        EXPECT_LT(
            glm::distance(glm::dvec3(points[i]), glm::dvec3(groom.points[i]) + moved), 4.4e-5);
    }
}

TEST_P(GpuShapeSolver, StaysNearTheReferenceForAHundredSteps) {
    for (const StiffnessScaling scaling : {StiffnessScaling::thesis, StiffnessScaling::invariant})
        for (const std::uint32_t vertices : {2u, 3u, 8u, 9u, 33u, 64u}) {
            SimulationSettings settings = windy();
            settings.stiffness_scaling = scaling;
            expectNearReference(device(), wavyGroom(5, vertices), settings);
        }
}

// Each number of vertices is a kernel of its own, and kernels take longer to compile than to run.
// Continuous collisions move each vertex by itself, so one chunk and several are enough.
TEST_P(GpuShapeSolver, StaysNearTheReferenceWithContinuousCollisions) {
    for (const std::uint32_t vertices : {8u, 33u}) {
        SimulationSettings settings = windy();
        settings.stiffness_scaling = StiffnessScaling::invariant;
        settings.collision.continuous = true;
        expectNearReference(device(), wavyGroom(5, vertices), settings);
    }
}

TEST_P(GpuShapeSolver, GivesTheSameBitsEveryTime) {
    const groom::Groom groom = wavyGroom(37, 9);
    Simulation first(device(), groom, windy(), 3);
    Simulation second(device(), groom, windy(), 3);
    advance(device(), first, 50);
    for (int i = 0; i < 50; ++i) advance(device(), second, 1);  // in submissions of their own
    const auto points = first.readPositions();
    EXPECT_TRUE(sameBits(points, second.readPositions()));
    EXPECT_DOUBLE_EQ(first.time(), 50 * double{windy().time_step});

    first.reset();
    EXPECT_EQ(first.time(), 0.0);
    EXPECT_TRUE(sameBits(first.readPositions(), groom.points));
    advance(device(), first, 50);
    EXPECT_TRUE(sameBits(points, first.readPositions()));
}

// A strand's motion depends neither on its neighbours nor on its place in a work group.
TEST_P(GpuShapeSolver, MovesAStrandTheSameInAnyCompany) {
    const groom::Groom many = wavyGroom(21, 9);
    groom::Groom few = many;
    few.strand_count = 4;
    few.points.resize(4 * 9);
    Simulation crowd(device(), many, windy(), 3);
    Simulation group(device(), few, windy(), 3);
    advance(device(), crowd, 20);
    advance(device(), group, 20);
    auto points = crowd.readPositions();
    points.resize(few.points.size());
    EXPECT_TRUE(sameBits(points, group.readPositions()));
}

TEST_F(GpuSolver, SeedChangesTheWind) {
    const groom::Groom groom = wavyGroom(4, 8);
    Simulation first(device(), groom, windy(), 3);
    Simulation second(device(), groom, windy(), 4);
    advance(device(), first, 10);
    advance(device(), second, 10);
    EXPECT_FALSE(sameBits(first.readPositions(), second.readPositions()));
}

TEST_P(GpuShapeSolver, SettlesWithoutWindOrTime) {
    const groom::Groom groom = wavyGroom(4, 8);
    SimulationSettings calm = windy();
    calm.wind.strength = 0.0f;
    Simulation expected(device(), groom, calm, 3);
    advance(device(), expected, 100);

    SimulationSettings settings = windy();
    settings.settle_steps = 100;
    Simulation simulation(device(), groom, settings, 3);
    EXPECT_EQ(simulation.time(), 0.0);
    EXPECT_TRUE(sameBits(simulation.readPositions(), expected.readPositions()));
    advance(device(), simulation, 1);
    simulation.reset();
    EXPECT_TRUE(sameBits(simulation.readPositions(), expected.readPositions()));
}

TEST_F(GpuSolver, NoneStaysAtRest) {
    const groom::Groom groom = wavyGroom(4, 8);
    SimulationSettings settings = windy();
    settings.solver = Solver::none;
    settings.settle_steps = 3;
    Simulation simulation(device(), groom, settings, 3);
    advance(device(), simulation, 5);
    EXPECT_TRUE(sameBits(simulation.readPositions(), groom.points));
}

TEST_F(GpuSolver, ShowsWhereTheGuidesAre) {
    const groom::Groom groom = wavyGroom(4, 8);
    const Simulation simulation(device(), groom, windy(), 3);
    const GuideView view = simulation.guides();
    EXPECT_NE(view.positions, 0u);
    EXPECT_EQ(view.strand_count, 4u);
    EXPECT_EQ(view.vertices_per_strand, 8u);
}

// More work groups than one row of a dispatch holds (65,535 strands that fill a work group each).
TEST_F(GpuSolver, MovesMoreStrandsThanARowOfWorkgroups) {
    const groom::Groom one = wavyGroom(1, 33);
    groom::Groom groom{.strand_count = 66000, .vertices_per_strand = 33};
    for (std::uint32_t s = 0; s < groom.strand_count; ++s)
        groom.points.insert(groom.points.end(), one.points.begin(), one.points.end());
    SimulationSettings settings;  // no wind, so that all strands move alike
    settings.parallelism = Parallelism::vertex;  // a work group for each strand
    settings.local.iterations = 1;
    settings.length.iterations = 1;
    Simulation simulation(device(), groom, settings, 3);
    Simulation single(device(), one, settings, 3);
    advance(device(), simulation, 1);
    advance(device(), single, 1);
    const auto points = simulation.readPositions();
    const auto expected = single.readPositions();
    for (const std::size_t strand : {0u, 65534u, 65535u, 65999u})
        for (std::size_t v = 0; v < 33; ++v)
            EXPECT_EQ(points[strand * 33 + v], expected[v]) << strand;
}

}  // namespace
}  // namespace hair::simulation
