#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "engine/buffer_image.h"
#include "engine/error.h"
#include "engine/transfer.h"
#include "hair/gpu_structs.h"
#include "hair/reference/constraints.h"
#include "hair/reference/solvers.h"
#include "hair/simulation/forces.h"
#include "hair/simulation/solvers.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/simulation/gpu_simulation.h"
#include "tests/simulation/pulls.h"

// Tests hands on the device against theory and against the reference.
namespace hair::simulation {
namespace {

class GpuPull : public GpuTest {
protected:
    static engine::Buffer bufferOf(const std::vector<glm::vec3>& vectors, const char* name) {
        std::vector<glm::vec4> padded;
        for (const glm::vec3& vector : vectors) padded.emplace_back(vector, 0.0f);
        return engine::makeBuffer(device(), padded, name, "tests");
    }

    // Returns the accelerations `before` after the pass alone, m/s^2.
    static std::vector<glm::vec4> accelerations(
        const groom::Groom& groom, const SimulationSettings& settings,
        const std::vector<glm::vec3>& positions, const std::vector<glm::vec3>& previous,
        const std::vector<glm::vec3>& before, const gpu::Step& step, double time) {
        const engine::Buffer now = bufferOf(positions, "positions");
        const engine::Buffer earlier = bufferOf(previous, "previous");
        const engine::Buffer rest = bufferOf(groom.points, "rest");
        const engine::Buffer result = bufferOf(before, "accelerations");
        const std::array guides{gpu::GuideParameters{
            .positions = now.address(),
            .previous = earlier.address(),
            .rest_positions = rest.address(),
            .gravity = settings.gravity,
            .step = step,
            .strand_count = groom.strand_count,
            .vertices_per_strand = groom.vertices_per_strand}};
        const engine::Buffer parameters =
            engine::makeBuffer(device(), guides, "parameters", "tests");
        const PullPass pass(
            device(), groom.strand_count, groom.vertices_per_strand, step, settings.pulls);
        runOnce(device(), [&](engine::Commands& commands) {
            pass.record(
                commands,
                {.parameters = parameters.address(),
                 .positions = now.address(),
                 .previous = earlier.address(),
                 .accelerations = result.address()},
                time);
        });
        return engine::downloadAs<glm::vec4>(device(), result);
    }
};

// Covers substeps shorter than the step, accelerations that are there already, times in the middle
// of every path, and hands that don't pull. Velocities are differences of positions of 0.1 m over 4
// ms, off by 2^-25 of 0.1 m each: 1.5e-6 m/s, from which a stiff hand makes 1.5e-6 / dt = 1e-4
// m/s^2.
TEST_F(GpuPull, PullsLikeTheReferenceAtAnyTime) {
    const groom::Groom groom = wavyGroom(37, 6);
    SimulationSettings settings;
    settings.pulls = manyPulls();
    settings.substeps = 4;
    const gpu::Step step = stepOf(settings);
    const auto positions = disturbed(groom, 0.01, 11);
    const auto previous = disturbed(groom, 0.01, 12);
    std::mt19937 random(13);
    std::vector<glm::vec3> before;
    for (std::size_t i = 0; i < groom.points.size(); ++i)
        before.emplace_back(20.0 * randomVector(random));
    const double dt = settings.time_step;
    for (const double time : {0.0, 0.5, 0.99, 2.0, 500.5}) {
        const auto result = accelerations(groom, settings, positions, previous, before, step, time);
        auto expected = toDouble(before);
        for (glm::dvec3& a : expected) a += glm::dvec3(settings.gravity);
        const auto rest = toDouble(groom.points);
        const auto now = toDouble(positions);
        const auto earlier = toDouble(previous);
        reference::addPulls(
            settings.pulls,
            {.vertices = groom.vertices_per_strand,
             .rest = rest,
             .positions = now,
             .previous = earlier,
             .substep = step.sub,
             .from = time,
             .to = time + dt},
            expected);
        ASSERT_EQ(result.size(), expected.size());
        Extremes errors;
        Extremes changes;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            const glm::dvec3 wanted = expected[i] - glm::dvec3(settings.gravity);
            changes.add(glm::distance(wanted, glm::dvec3(before[i])));
            errors.add(glm::distance(glm::dvec3(result[i]), wanted));
            if (i % groom.vertices_per_strand == 0) {
                EXPECT_EQ(glm::vec3(result[i]), before[i]) << "root " << i;
            }
        }
        EXPECT_GT(changes.greatest(), 1.0) << time;
        // 1e-4 m/s^2 as above, plus ten roundings.
        EXPECT_LT(errors.greatest(), 1e-4 + 10 * 0x1p-24 * changes.greatest()) << time;
    }
}

TEST_F(GpuPull, StepsLikeTheReference) {
    for (const Solver solver : {Solver::shape, Solver::ftl})
        for (const std::uint32_t substeps : {1u, 4u}) {
            const groom::Groom groom = wavyGroom(33, 9);
            SimulationSettings settings;
            settings.solver = solver;
            settings.substeps = substeps;
            settings.wind.strength = 5.0f;
            settings.pulls = manyPulls();
            const auto positions = disturbed(groom, 0.005, 11);
            const auto previous = disturbed(groom, 0.005, 12);
            Simulation simulation(device(), groom, settings, 3);
            reference::Reference solution(groom, settings, 3);
            simulation.setState(positions, previous);
            solution.setState(toDouble(positions), toDouble(previous));
            advance(device(), simulation, 1);
            solution.step();
            // The tolerance of gpu_constraints_test.cpp, for every substep.
            EXPECT_LT(
                largestDifference(simulation.readPositions(), solution.positions()),
                substeps * 1e-5 * longestStrand(groom))
                << substeps << " substeps";
        }
}

// Positions up to 0.5 m are rounded by 2^-26 m, and their difference, the velocity, by twice that.
// A kick in step 0 has moved the vertex by up to n / (1 + s)^n kicks in step n. Summed over all
// steps before, that is (1 + s) / s^2 kicks: 12 at s = 1/3. The hand's position is rounded, too.
TEST_F(GpuPull, ApproachesTheHandAsCriticallyDamped) {
    const groom::Groom groom = straightGroom(1, 2);
    const glm::vec3 hand(0.4f, 0.2f, -0.1f);
    const float stiffness = 400.0f;
    SimulationSettings settings = nothingActs();
    settings.pulls = {{.stiffness = stiffness, .path = stays(hand)}};
    Simulation simulation(device(), groom, settings, 1);
    const glm::dvec3 start = glm::dvec3(groom.points[1]) - glm::dvec3(hand);
    for (int n = 1; n <= 90; ++n) {
        advance(device(), simulation, 1);
        const glm::dvec3 expected =
            glm::dvec3(hand) + approach(n, stiffness, settings.time_step) * start;
        ASSERT_LT(
            glm::distance(glm::dvec3(simulation.readPositions()[1]), expected), 12 * 4 * 0x1p-26)
            << n;
    }
}

// With such a soft spring the offset is large: 9.8 / 40 = 0.245 m. A step moves the position only
// if its change exceeds half of the position's rounding, 2^-26 m below 0.5 m. So the offset is
// found to that times (1 + s)^2 / s^2, which is 110 at s = 0.105.
TEST_F(GpuPull, BalancesGravity) {
    const groom::Groom groom = straightGroom(1, 2);
    SimulationSettings settings = nothingActs();
    settings.gravity = {0, -9.8f, 0};
    settings.pulls = {{.stiffness = 40.0f, .path = stays({0, 0.25f, 0})}};
    Simulation simulation(device(), groom, settings, 1);
    advance(device(), simulation, 600);
    EXPECT_NEAR(simulation.readPositions()[1].y, 0.25 - 9.8 / 40.0, 2 * 110 * 0x1p-26);
}

// Free tips lie 0, 5, 10 ... cm from the held one.
TEST_F(GpuPull, FallsOffToOneOverEAtTheRadius) {
    const groom::Groom groom = straightGroom(5, 2);
    SimulationSettings settings = nothingActs();
    for (const float radius : {0.05f, 0.1f, 0.0f}) {
        settings.pulls = {{.radius = radius, .stiffness = 1e5f, .path = stays({0, 0, 1})}};
        Simulation simulation(device(), groom, settings, 1);
        advance(device(), simulation, 1);
        const auto points = simulation.readPositions();
        const double whole = points[1].z;
        EXPECT_GT(whole, 0.7);  // s^2 / (1 + s)^2 of 1 m, s = sqrt(1e5) / 60
        for (std::size_t strand = 1; strand < 5; ++strand) {
            const double radii = 0.05 * static_cast<double>(strand) / double{radius};
            const double part = radius > 0.0f ? std::exp(-radii * radii) : 0.0;
            // The radius and the rest positions are rounded to 2^-24 of themselves.
            EXPECT_NEAR(points[2 * strand + 1].z / whole, part, 1e-6) << radius;
        }
    }
}

TEST_F(GpuPull, ChangesNothingOutsideItsTime) {
    const groom::Groom groom = wavyGroom(9, 8);
    for (const Solver solver : kSolvers) {
        SimulationSettings settings;
        settings.solver = solver;
        settings.settle_steps = 3;
        settings.wind.strength = 5.0f;
        Simulation alone(device(), groom, settings, 3);
        settings.pulls = {
            {.radius = 1.0f, .path = {{.time = 0.5f, .position = {1, 1, 1}}, {.time = 0.75f}}}};
        Simulation held(device(), groom, settings, 3);
        advance(device(), alone, 30);
        advance(device(), held, 30);
        EXPECT_EQ(held.readPositions(), alone.readPositions());
        advance(device(), alone, 1);
        advance(device(), held, 1);
        EXPECT_NE(held.readPositions(), alone.readPositions());
    }
}

// With a stiff spring and a long step, a free vertex goes to the hand at once and stays there, even
// if the greatest possible number of hands hold it. With n > 1 substeps a step moves it less far
// than implicit Euler assumes. The remaining error shrinks by the root of (1 - 1/n) / 2 in a step:
// to a third after each third step.
TEST_F(GpuPull, IsStableAtTheStiffest) {
    const groom::Groom groom = straightGroom(1, 2);
    const glm::vec3 hand(0.4f, 0.2f, -0.1f);
    for (const std::size_t hands : {1u, 64u})
        for (const std::uint32_t substeps : {1u, 2u, 64u})
            for (const float stiffness : {400.0f, 1e5f}) {
                SimulationSettings settings = nothingActs();
                settings.time_step = 0.1f;
                settings.substeps = substeps;
                settings.pulls.assign(hands, {.stiffness = stiffness, .path = stays(hand)});
                Simulation simulation(device(), groom, settings, 1);
                advance(device(), simulation, 60);
                // In each of n substeps every coordinate is rounded by up to 2^-26 m, and the
                // rounding continues as velocity: n (n + 1) / 2 of it. Fewer than three steps
                // contribute.
                const double rounding = std::sqrt(3.0) * 0x1p-26 * substeps * (substeps + 1) / 2;
                EXPECT_LT(
                    glm::distance(simulation.readPositions()[1], hand),
                    3.0 * rounding + 4 * 0x1p-26)
                    << hands << " hands, " << substeps << " substeps";
            }
}

// Twelve hands pull at a time: each radius with each stiffness, at a tip that is jerked and at a
// first vertex that is held.
TEST_F(GpuPull, StaysFiniteWithEverySolver) {
    const groom::Groom groom = wavyGroom(20, 8);
    SimulationSettings settings;
    std::uint32_t strand = 0;
    for (const float stiffness : {0.0f, 1e5f})
        for (const float radius : {0.0f, std::numeric_limits<float>::denorm_min(), 10.0f}) {
            settings.pulls.push_back(
                {.guide = strand++,
                 .vertex = 7,
                 .radius = radius,
                 .stiffness = stiffness,
                 .path = jerks({0, 0, 0})});
            settings.pulls.push_back(
                {.guide = strand++,
                 .vertex = 1,
                 .radius = radius,
                 .stiffness = stiffness,
                 .path = stays({100, 100, 100})});
        }
    for (const Solver solver : kSolvers)
        for (const float step : {0.0005f, 1.0f / 60.0f, 0.1f}) {
            settings.solver = solver;
            settings.time_step = step;
            Simulation simulation(device(), groom, settings, 1);
            advance(device(), simulation, 100);
            for (const glm::vec3& point : simulation.readPositions())
                ASSERT_TRUE(std::isfinite(point.x + point.y + point.z)) << step;
        }
}

// The tip follows the hand, a reset repeats the same bits, and the roots stay.
TEST_F(GpuPull, GivesTheSameBitsEveryTime) {
    const groom::Groom groom = straightGroom(20, 8);
    const glm::vec3 hand = groom.points[0] + glm::vec3(0.1f, -0.05f, 0.0f);
    for (const Solver solver : kSolvers) {
        SimulationSettings settings;
        settings.solver = solver;
        // Springs to a ghost of the rest shape would pull against the hand.
        settings.augmented_mass_spring.integrity = 0.0f;
        settings.augmented_mass_spring.angular_stiffness = 0.0f;
        Simulation alone(device(), groom, settings, 3);
        settings.pulls = {
            {.guide = 0, .vertex = 7, .radius = 0.06f, .stiffness = 5000.0f, .path = stays(hand)}};
        Simulation first(device(), groom, settings, 3);
        Simulation second(device(), groom, settings, 3);
        advance(device(), first, 90);
        for (int i = 0; i < 90; ++i) advance(device(), second, 1);
        const auto points = first.readPositions();
        EXPECT_EQ(points, second.readPositions());
        // The hand is 11 cm from the root of a hair of 15 cm: the tip has moved most of the 14 cm.
        EXPECT_LT(glm::distance(points[7], hand), 0.035f);
        // The neighbour's tip gets 1/2 of the pull. The last strand's gets exp(-250), which is 0 in
        // float.
        advance(device(), alone, 90);
        const auto hanging = alone.readPositions();
        EXPECT_GT(glm::distance(points[15], hanging[15]), 0.01f);
        EXPECT_EQ(points[159], hanging[159]);
        for (std::size_t root = 0; root < points.size(); root += 8)
            EXPECT_EQ(points[root], groom.points[root]);
        first.reset();
        advance(device(), first, 90);
        EXPECT_EQ(points, first.readPositions());
    }
}

TEST_F(GpuPull, RefusesWhatTheGroomDoesNotHave) {
    const groom::Groom groom = straightGroom(3, 4);
    SimulationSettings settings;
    settings.pulls = {{.guide = 2, .vertex = 3}, {.guide = 3}};
    try {
        const Simulation simulation(device(), groom, settings, 1);
        FAIL() << "was taken";
    } catch (const engine::Error& error) {
        EXPECT_EQ(
            std::string(error.what()),
            "/simulation/pulls/1/guide: 3 is too large: the groom has 3 guides");
    }
}

}  // namespace
}  // namespace hair::simulation
