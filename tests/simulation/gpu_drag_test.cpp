#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/buffer_image.h"
#include "engine/transfer.h"
#include "hair/gpu_structs.h"
#include "hair/reference/solvers.h"
#include "hair/reference/wind.h"
#include "hair/simulation/forces.h"
#include "hair/simulation/solvers.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/simulation/drag.h"
#include "tests/simulation/gpu_simulation.h"

// Tests air on the device against the reference in double precision.
namespace hair::simulation {
namespace {

constexpr std::uint32_t kSeed = 5;

SimulationSettings turbulent(float speed) {
    SimulationSettings settings = fallingThroughAir(1.0f / 60.0f);
    settings.wind.direction = {0.3f, -1.0f, 0.5f};
    settings.wind.speed = speed;
    settings.wind.turbulence = 0.7f;
    settings.wind.turbulence_octaves = 4;
    return settings;
}

class GpuDrag : public GpuTest {
protected:
    // Returns the air's velocity at `time` as the pass computes it, m/s.
    static std::vector<glm::dvec3> airAt(
        const groom::Groom& groom, const SimulationSettings& settings,
        const std::vector<glm::vec3>& positions, double time) {
        const auto buffer = [](const std::vector<glm::vec3>& points, const char* name) {
            std::vector<glm::vec4> padded;
            for (const glm::vec3& point : points) padded.emplace_back(point, 0.0f);
            return engine::makeBuffer(device(), padded, name, "tests");
        };
        const engine::Buffer now = buffer(positions, "positions");
        const engine::Buffer accelerations = buffer(positions, "accelerations");
        const std::array guides{gpu::GuideParameters{
            .positions = now.address(),
            .gravity = settings.gravity,
            .step = stepOf(settings),
            .strand_count = groom.strand_count,
            .vertices_per_strand = groom.vertices_per_strand,
            .seed = kSeed}};
        const engine::Buffer parameters =
            engine::makeBuffer(device(), guides, "parameters", "tests");
        const WindPass pass(device(), groom.strand_count * groom.vertices_per_strand, settings);
        runOnce(device(), [&](engine::Commands& commands) {
            pass.record(
                commands,
                {.parameters = parameters.address(),
                 .positions = now.address(),
                 .accelerations = accelerations.address()},
                time);
        });
        for (const glm::vec4& each : engine::downloadAs<glm::vec4>(device(), accelerations))
            EXPECT_EQ(each, glm::vec4(0.0f));
        std::vector<glm::vec3> air;
        for (const glm::vec4& each :
             engine::downloadAs<glm::vec4>(device(), *pass.air().velocities))
            air.emplace_back(each);
        return toDouble(air);
    }
};

// Includes winds that have blown for so long that they have moved by more than 2^32 cells. A
// position in cells is rounded twice in float, within a metre and a cell, and once in double
// precision, together with the distance that the wind has covered. Four octaves of noise have a
// derivative of a few tens per smallest cell, and their sums are rounded about 16 times.
TEST_F(GpuDrag, BlowsLikeTheReferenceAtAnyTime) {
    const groom::Groom groom = wavyGroom(40, 8);
    for (const float scale : {10.0f, 0.5f, 0.1f})
        for (const double time : {0.0, 0.77, 1e4, 1e7}) {
            SimulationSettings settings = turbulent(50.0f);
            settings.wind.turbulence_scale = scale;
            const auto positions = disturbed(groom, 0.005, 11);
            std::vector<glm::dvec3> expected;
            for (const glm::dvec3& point : toDouble(positions))
                expected.push_back(reference::airVelocity(settings.wind, kSeed, point, time));
            const double speed = settings.wind.speed;
            const double cells =
                0x1p-23 * (1.0 + 1.0 / double{scale}) + 0x1p-52 * speed * time / double{scale};
            EXPECT_LT(
                largestDifference(airAt(groom, settings, positions, time), expected),
                (30.0 * cells + 0x1p-20) * double{settings.wind.turbulence} * speed)
                << scale << " m at " << time << " s";
        }
}

TEST_F(GpuDrag, StepsLikeTheReference) {
    for (const std::uint32_t substeps : {1u, 4u})
        for (const WindMode mode : {WindMode::thesis, WindMode::drag}) {
            const groom::Groom groom = wavyGroom(33, 9);
            SimulationSettings settings = turbulent(3.0f);
            settings.substeps = substeps;
            settings.wind.mode = mode;
            settings.wind.strength = 15.0f;
            const auto positions = disturbed(groom, 0.005, 11);
            const auto previous = disturbed(groom, 0.005, 12);
            Simulation simulation(device(), groom, settings, kSeed);
            reference::Reference solver(groom, settings, kSeed);
            simulation.setState(positions, previous);
            solver.setState(toDouble(positions), toDouble(previous));
            advance(device(), simulation, 1);
            solver.step();
            // A float position near 1 m is stored to 6e-8 m.
            EXPECT_LT(
                largestDifference(simulation.readPositions(), solver.positions()),
                1e-5 * longestStrand(groom));

            simulation.setState(positions, previous);
            solver.setState(toDouble(positions), toDouble(previous));
            simulation.settle(1);
            solver.settle();
            EXPECT_LT(
                largestDifference(simulation.readPositions(), solver.positions()),
                1e-5 * longestStrand(groom));
        }
}

TEST_F(GpuDrag, LetsHairFallAtTheSpeedWhereItBearsTheWeight) {
    for (const float step : {1.0f / 120.0f, 1.0f / 60.0f, 0.1f}) {
        const SimulationSettings settings = fallingThroughAir(step);
        Simulation simulation(device(), levelHair(), settings, kSeed);
        advance(device(), simulation, kFreeSteps);
        const double moved =
            simulation.readPositions().back().y - double{simulation.readPrevious().back().y};
        const double speed = fallingSpeed(settings);
        // 5e-6 as on the CPU, plus the rounding of both positions after the fall.
        const double fallen = speed * kFreeSteps * double{step};
        EXPECT_NEAR(
            -moved / double{step}, speed, 5e-6 * speed + 2.0 * 0x1p-24 * fallen / double{step})
            << step;
    }
}

// Hair with its own mass of water moves like hair of twice the density, in air and by its
// stiffness.
TEST_F(GpuDrag, MovesWetHairLikeHeavierHair) {
    const groom::Groom groom = wavyGroom(33, 9);
    for (const Solver solver :
         {Solver::shape, Solver::ftl, Solver::rod, Solver::stable_cosserat,
          Solver::position_based_rod, Solver::augmented_mass_spring}) {
        const auto played = [&](float density, float water) {
            SimulationSettings settings = turbulent(3.0f);
            settings.solver = solver;
            settings.wind.drag_along = 1.5f;
            settings.material.density = density;
            settings.material.water = water;
            Simulation simulation(device(), groom, settings, kSeed);
            advance(device(), simulation, 10);
            return simulation.readPositions();
        };
        const auto wet = played(1000.0f, 1.0f);
        EXPECT_EQ(wet, played(2000.0f, 0.0f)) << static_cast<int>(solver);
        EXPECT_NE(wet, played(1000.0f, 0.0f)) << static_cast<int>(solver);
    }
}

TEST_F(GpuDrag, StaysFiniteInAStorm) {
    const groom::Groom groom = wavyGroom(40, 8);
    for (const float step : {0.0005f, 0.1f})
        for (const float radius : {1e-6f, 37e-6f})
            for (const float density : {0.0f, 1.2f, 1000.0f}) {
                SimulationSettings settings;
                settings.time_step = step;
                settings.material.radius = radius;
                settings.wind = {
                    .mode = WindMode::drag,
                    .speed = 100.0f,
                    .turbulence = 2.0f,
                    .turbulence_scale = 0.01f,
                    .turbulence_octaves = 8,
                    .air_density = density,
                    .drag_along = 100.0f};
                Simulation simulation(device(), groom, settings, kSeed);
                advance(device(), simulation, 100);
                for (const glm::vec3& point : simulation.readPositions())
                    ASSERT_TRUE(std::isfinite(point.x + point.y + point.z)) << step;
            }
}

TEST_F(GpuDrag, StandsHairWithoutDirections) {
    groom::Groom groom{.strand_count = 1, .vertices_per_strand = 5};
    groom.points = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0.1f, 0}, {0, 0, 0}};
    for (const Parallelism parallelism : {Parallelism::automatic, Parallelism::serial}) {
        SimulationSettings settings = turbulent(5.0f);
        settings.parallelism = parallelism;
        Simulation simulation(device(), groom, settings, kSeed);
        reference::Reference solver(groom, settings, kSeed);
        advance(device(), simulation, 1);
        solver.step();
        // The hair moves by a few mm at 5 m/s.
        EXPECT_LT(largestDifference(simulation.readPositions(), solver.positions()), 1e-6);
    }
}

TEST_F(GpuDrag, IsBorneByASpringAtAnyStep) {
    for (const float step : {1.0f / 480.0f, 1.0f / 60.0f, 0.1f})
        for (const std::uint32_t substeps : {1u, 4u})
            for (const Solver solver : kSolversOfPositions) {
                const SimulationSettings settings = onSpring(solver, step, substeps);
                Simulation simulation(device(), levelPair(), settings, kSeed);
                advance(device(), simulation, restingSteps(settings));
                // The tolerance of 1e-4 is the reference's, for values of 24 bits.
                EXPECT_NEAR(
                    double{simulation.readPositions().back().z} / springsStretch(settings), 1.0,
                    1e-4)
                    << static_cast<int>(solver) << ' ' << step << ' ' << substeps;
            }
}

// Every solver with all its forces, drag along the hair among them, each kind of parallelism, and
// several substeps.
TEST_F(GpuDrag, BrakesEverySolverAsTheReferenceSays) {
    for (const Solver solver : kSolvers)
        for (const Parallelism parallelism :
             {Parallelism::vertex, Parallelism::strand, Parallelism::serial}) {
            if (solver != Solver::shape && parallelism != Parallelism::vertex) continue;
            const groom::Groom groom = wavyGroom(33, 9);
            SimulationSettings settings;
            settings.wind = turbulent(6.0f).wind;
            settings.wind.drag_along = 1.5f;
            settings.solver = solver;
            settings.parallelism = parallelism;
            settings.substeps = 3;
            Simulation simulation(device(), groom, settings, kSeed);
            reference::Reference reference(groom, settings, kSeed);
            advance(device(), simulation, 2);
            for (int i = 0; i < 2; ++i) reference.step();
            // Same tolerance as without wind: gpu_rod_test.cpp, near_reference.h.
            EXPECT_LT(
                largestDifference(simulation.readPositions(), reference.positions()),
                1e-5 * longestStrand(groom))
                << static_cast<int>(solver) << ' ' << static_cast<int>(parallelism);
        }
}

// Friction or cohesion of hair on hair shares the grid, the head has turned, and hair moves in all
// directions. One step: where hair moves almost as the air does, rounding decides on the direction
// upstream.
// Elsewhere it moves a ray of ten cells by some 1e-5 cells, air of 10 m/s by about as much of its
// speed, and hair by 1e-4 m/s in 1/60 s: three times the usual tolerance.
TEST_F(GpuDrag, IsSlowedByHairAsTheReferenceSays) {
    for (const Solver solver : {Solver::shape, Solver::rod})
        for (const float density : {1.2f, 0.0f}) {
            const groom::Groom groom = wavyGroom(60, 9);
            SimulationSettings settings;
            settings.wind = turbulent(6.0f).wind;
            settings.wind.air_density = density;
            settings.wind.drag_along = 1.5f;
            settings.solver = solver;
            settings.substeps = 3;
            if (solver == Solver::rod)
                settings.hair_hair.cohesion = 0.1f;
            else
                settings.hair_hair.friction = 0.1f;
            settings.hair_hair.shelter = 60.0f;
            settings.motion.keyframes = {
                {.time = 0.0f, .rotation = {10.0f, 40.0f, 0.0f}, .translation = {}},
                {.time = 1.0f, .rotation = {20.0f, 60.0f, 0.0f}, .translation = {}}};
            Simulation simulation(device(), groom, settings, kSeed);
            reference::Reference reference(groom, settings, kSeed);
            const auto moved_by_head = [&](const std::vector<glm::vec3>& points) {
                std::vector<glm::vec3> moved;
                for (const glm::vec3& point : points)
                    moved.emplace_back(simulation.pose()(glm::dvec3(point)));
                return moved;
            };
            const auto positions = moved_by_head(disturbed(groom, 0.002, 11));
            const auto previous = moved_by_head(disturbed(groom, 0.002, 12));
            simulation.setState(positions, previous);
            reference.setState(toDouble(positions), toDouble(previous));
            advance(device(), simulation, 1);
            reference.step();
            EXPECT_LT(
                largestDifference(simulation.readPositions(), reference.positions()),
                3e-5 * longestStrand(groom))
                << static_cast<int>(solver);

            // The shelter moves hair by far more than that.
            settings.hair_hair.shelter = 0.0f;
            reference::Reference open(groom, settings, kSeed);
            open.setState(toDouble(positions), toDouble(previous));
            open.step();
            const double apart = largestDifference(simulation.readPositions(), open.positions());
            if (density > 0.0f)
                EXPECT_GT(apart, 1e-2 * longestStrand(groom));
            else
                EXPECT_LT(apart, 3e-5 * longestStrand(groom));
        }
}

TEST_F(GpuDrag, NeedsNoDirectionWithoutWind) {
    for (const WindMode mode : {WindMode::thesis, WindMode::drag}) {
        SimulationSettings settings = inAir(1.0f / 60.0f);
        settings.wind.mode = mode;
        settings.wind.direction = glm::vec3(0.0f);
        const groom::Groom groom = wavyGroom(3, 4);
        Simulation simulation(device(), groom, settings, kSeed);
        advance(device(), simulation, 3);
        for (const glm::vec3& point : simulation.readPositions())
            EXPECT_TRUE(std::isfinite(point.x + point.y + point.z));
        settings.wind.speed = settings.wind.strength = 1.0f;
        EXPECT_THROW(Simulation(device(), groom, settings, kSeed), engine::Error);
    }
}

}  // namespace
}  // namespace hair::simulation
