#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/gpu_fixture.h"
#include "tests/simulation/gpu_simulation.h"
#include "tests/simulation/strands.h"

// Hair on a head with constant acceleration a is a pendulum under a gravity that leans back by
// atan(a / g).
namespace hair::simulation {
namespace {

constexpr double kGravity = 9.8;       // m/s^2, down
constexpr double kAcceleration = 4.0;  // m/s^2, toward +x

// x = a t^2 / 2 at every step. There is a keyframe at each step, so the motion between them does
// not matter.
MotionSettings accelerating(double time_step, int steps) {
    MotionSettings motion;
    for (int i = 0; i <= steps; ++i) {
        const double time = i * time_step;
        motion.keyframes.push_back(
            {.time = static_cast<float>(time),
             .translation = {0.5 * kAcceleration * time * time, 0, 0}});
    }
    return motion;
}

SimulationSettings hanging(Solver solver, float time_step, int steps) {
    SimulationSettings settings = nothingActs();
    settings.solver = solver;
    settings.time_step = time_step;
    settings.gravity = {0, -kGravity, 0};
    settings.length.iterations = 20;
    settings.motion = accelerating(double{time_step}, steps);
    return settings;
}

double leanOf(const glm::vec3& root, const glm::vec3& tip) {
    const glm::dvec3 edge = glm::dvec3(tip) - glm::dvec3(root);
    return std::atan2(-edge.x, -edge.y);
}

using Inertia = GpuTest;

// The strand starts at relative rest at that angle and stays there. A step adds a dt^2 sideways and
// g dt^2 down to a vertex relative to the root, and their sum lies along the strand.
TEST_F(Inertia, HoldsAStrandBackAtTheAngleOfThePendulum) {
    constexpr int kSteps = 64;
    constexpr float kStep = 1.0f / 64.0f;  // exact, as are the times of its keyframes
    const double lean = std::atan(kAcceleration / kGravity);
    for (const Solver solver : {Solver::shape, Solver::ftl}) {
        const groom::Groom groom = straightGroom(2, 8);
        Simulation simulation(device(), groom, hanging(solver, kStep, kSteps), 1);
        std::vector<glm::vec3> start;
        for (const glm::vec3& point : groom.points) {
            const double below = -double{point.y};
            start.emplace_back(
                double{point.x} - std::sin(lean) * below, -std::cos(lean) * below, 0.0);
        }
        // Position on the parabola one step before its vertex.
        std::vector<glm::vec3> before = start;
        for (glm::vec3& point : before) point.x += 0.5f * float{kAcceleration} * kStep * kStep;
        simulation.setState(start, before);
        for (int i = 0; i < kSteps; ++i) {
            advance(device(), simulation, 1);
            const auto points = simulation.readPositions();
            // Keyframes up to 2 m are rounded by 6e-8 m a step at random. This is an acceleration
            // of 4 * 6e-8 m / dt^2 = 1e-3 m/s^2, or 1e-4 rad; the tolerance is three times that for
            // resonances.
            for (const std::size_t tip : {7u, 15u})
                ASSERT_NEAR(leanOf(points[tip - 7], points[tip]), lean, 3e-4) << i;
        }
    }
}

// From rest a pendulum of one segment swings to twice that angle, where its energy is used up, and
// back to the plumb line. The projection onto a length costs energy: in a step of h a vertex first
// moves out by g_eff h^2 along the strand and is then moved in. Its speed shrinks like its
// distance, by (g_eff / l) h^2. So the amplitude decays as exp(-w^2 h t / 2), w^2 = g_eff / l.
TEST_F(Inertia, SwingsAPendulumToTwiceTheAngle) {
    constexpr float kStep = 1.0f / 1024.0f;
    constexpr double kLength = 0.1;
    const double lean = std::atan(kAcceleration / kGravity);
    const double w = std::sqrt(std::hypot(kAcceleration, kGravity) / kLength);
    // The period at that amplitude as a series, whose next term is below 1e-6.
    const double square = lean * lean;
    const double period =
        2.0 * std::numbers::pi / w * (1.0 + square / 16.0 + 11.0 * square * square / 3072.0);
    const int half = static_cast<int>(std::lround(0.5 * period / double{kStep}));
    const double left = std::exp(-0.25 * w * w * double{kStep} * period);  // after half a period
    // The formula of the decay holds for small angles and speeds. The tolerance is 0.2 of the
    // decay.
    const double tolerance = 0.2 * (1.0 - left) * lean;
    for (const Solver solver : {Solver::shape, Solver::ftl}) {
        const groom::Groom groom = straightGroom(1, 2, kLength);
        Simulation simulation(device(), groom, hanging(solver, kStep, 2 * half), 1);
        advance(device(), simulation, half);
        auto points = simulation.readPositions();
        EXPECT_NEAR(leanOf(points[0], points[1]), lean * (1.0 + left), tolerance);
        advance(device(), simulation, half);
        points = simulation.readPositions();
        EXPECT_NEAR(leanOf(points[0], points[1]), lean * (1.0 - left * left), 2.0 * tolerance);
    }
}

// When a head stops, its hair swings on, ahead of it.
TEST_F(Inertia, CarriesHairPastAHeadThatStops) {
    const groom::Groom groom = straightGroom(1, 8);
    SimulationSettings settings;
    settings.motion.keyframes = {{.time = 0.0f}, {.time = 0.5f, .translation = {0.5f, 0, 0}}};
    Simulation simulation(device(), groom, settings, 1);
    advance(device(), simulation, 9);  // 0.15 s: at full acceleration
    auto points = simulation.readPositions();
    EXPECT_GT(leanOf(points[0], points[7]), 0.05);
    advance(device(), simulation, 24);  // 0.55 s: just stopped
    points = simulation.readPositions();
    EXPECT_LT(leanOf(points[0], points[7]), -0.05);
}

}  // namespace
}  // namespace hair::simulation
