// Tests caches of the guides' motion: groom::GuideCache and hair/simulation/cache.h.
#include "hair/simulation/forces.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "hair/simulation/simulation.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/simulation/gpu_simulation.h"
#include "tests/simulation/motions.h"
#include "tests/simulation/strands.h"

namespace hair::simulation {
namespace {

TEST(CacheInterval, IsFoundAtBetweenBeforeAndAfterSamples) {
    const std::vector<double> times{0.0, 0.5, 2.0};
    const auto expect = [&](double time, std::size_t before, std::size_t after, double fraction) {
        const CacheInterval found = intervalAt(times, time);
        EXPECT_EQ(found.before, before) << time;
        EXPECT_EQ(found.after, after) << time;
        EXPECT_DOUBLE_EQ(found.fraction, fraction) << time;
    };
    expect(-1.0, 0, 0, 0.0);
    expect(0.0, 0, 1, 0.0);
    expect(0.125, 0, 1, 0.25);
    expect(0.5, 1, 2, 0.0);
    expect(1.25, 1, 2, 0.5);
    expect(2.0, 2, 2, 0.0);
    expect(9.0, 2, 2, 0.0);
}

// A motion that is not linear, so that interpolation differs from it: every vertex rises with the
// square of time and turns along x with its height.
glm::dvec3 movedBy(const glm::vec3& rest, double time) {
    return glm::dvec3(rest) + glm::dvec3(0.3 * std::sin(3.0 * time + rest.y), time * time, 0.0);
}

constexpr double kRate = 24.0;  // samples per second
constexpr std::size_t kSamples = 9;  // to 1/3 s

groom::Groom playing() {
    groom::Groom groom = wavyGroom(9, 8);
    for (std::size_t i = 0; i < kSamples; ++i) {
        groom.cache.times.push_back(static_cast<double>(i) / kRate);
        for (const glm::vec3& rest : groom.points)
            groom.cache.points.emplace_back(movedBy(rest, groom.cache.times.back()));
    }
    return groom;
}

// Linear interpolation of the samples, in double precision.
std::vector<glm::vec3> expectedAt(const groom::Groom& groom, double time) {
    const double place = std::clamp(time * kRate, 0.0, double{kSamples - 1});
    // A time within a rounding of a sample is at it from either side.
    const auto before = std::min(static_cast<std::size_t>(place), kSamples - 2);
    const double fraction = place - static_cast<double>(before);
    const std::size_t count = groom.points.size();
    std::vector<glm::vec3> points;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 a = groom.cache.points[before * count + i];
        const glm::dvec3 b = groom.cache.points[(before + 1) * count + i];
        points.emplace_back(a + fraction * (b - a));
    }
    return points;
}

// Coordinates are below 1 m, where floats are 6e-8 m apart; time is the float next to 1/60 s.
constexpr double kCacheRounding = 2e-7;

SimulationSettings still() {
    SimulationSettings settings;
    settings.solver = Solver::none;
    settings.time_step = 1.0f / 60.0f;
    return settings;
}

using Cache = GpuTest;

TEST_F(Cache, PlaysSamplesOf24FramesASecondAt60) {
    const groom::Groom groom = playing();
    Simulation simulation(device(), groom, still(), 1);
    ASSERT_TRUE(simulation.moves());
    EXPECT_EQ(largestDifference(simulation.readPositions(), expectedAt(groom, 0.0)), 0.0);
    for (int frame = 1; frame <= 24; ++frame) {
        advance(device(), simulation, 1);
        EXPECT_LT(
            largestDifference(simulation.readPositions(), expectedAt(groom, frame / 60.0)),
            kCacheRounding)
            << frame;
    }
    // The samples end after 20 frames. A second round is equal to the first.
    EXPECT_EQ(largestDifference(simulation.readPositions(), expectedAt(groom, 1.0)), 0.0);
    simulation.reset();
    EXPECT_EQ(largestDifference(simulation.readPositions(), expectedAt(groom, 0.0)), 0.0);
    advance(device(), simulation, 7);
    EXPECT_LT(
        largestDifference(simulation.readPositions(), expectedAt(groom, 7 / 60.0)), kCacheRounding);
}

TEST_F(Cache, IsCarriedByTheHead) {
    const groom::Groom groom = playing();
    SimulationSettings settings = still();
    settings.motion = nodding();
    Simulation simulation(device(), groom, settings, 1);
    advance(device(), simulation, 13);
    std::vector<glm::vec3> expected;
    for (const glm::vec3& point : expectedAt(groom, 13 / 60.0))
        expected.emplace_back(simulation.pose()(point));
    EXPECT_LT(largestDifference(simulation.readPositions(), expected), 1e-6);
}

// The cache carries hair evenly through space, without turning or bending it. Hair that starts at
// rest then has to move with it: the transient of a critically damped spring of 1000/s^2 has fallen
// to (1 + w t) exp(-w t) = 2e-6 of 6 mm (its velocity over w) after 0.5 s.
TEST_F(Cache, IsFollowedByEverySolver) {
    const glm::vec3 velocity(0.2f, 0.05f, -0.1f);
    for (const Solver solver : kSolvers) {
        if (solver == Solver::none) continue;
        groom::Groom groom = wavyGroom(9, 8);
        groom.cache = {.times = {0.0, 1.0}, .points = groom.points, .strength = 1000.0f};
        for (const glm::vec3& rest : groom.points) groom.cache.points.push_back(rest + velocity);
        SimulationSettings settings;
        settings.solver = solver;
        settings.time_step = 1.0f / 60.0f;
        settings.gravity = glm::vec3(0.0f);
        settings.friction = 0.0f;  // of velocities
        Simulation simulation(device(), groom, settings, 1);
        advance(device(), simulation, 45);
        std::vector<glm::vec3> expected;
        for (const glm::vec3& rest : groom.points) expected.push_back(rest + 0.75f * velocity);
        const std::vector<glm::vec3> found = simulation.readPositions();
        EXPECT_LT(largestDifference(found, expected), 1e-4) << static_cast<int>(solver);
        for (std::size_t i = 0; i < found.size(); i += groom.vertices_per_strand)
            EXPECT_LT(glm::distance(found[i], expected[i]), 1e-6f) << "root " << i;
    }
}

}  // namespace
}  // namespace hair::simulation
