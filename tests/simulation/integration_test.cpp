#include <cmath>

#include <gtest/gtest.h>

#include "hair/reference/solvers.h"
#include "tests/simulation/strands.h"

namespace hair::simulation {
namespace {

// Returns the previous positions with which Verlet integration moves every vertex at `velocity`.
std::vector<glm::dvec3>
comingFrom(const groom::Groom& groom, const glm::dvec3& velocity, double step) {
    std::vector<glm::dvec3> previous = toDouble(groom.points);
    for (glm::dvec3& point : previous) point -= velocity * step;
    return previous;
}

// X_n = X_0 + n v dt + n (n + 1) / 2 g dt^2: the sum of the discrete velocities v dt + m g dt^2.
TEST(Verlet, FollowsItsDiscreteParabola) {
    const groom::Groom groom = straightGroom(1, 2);
    SimulationSettings settings = nothingActs();
    settings.gravity = {0.5f, -9.8f, 0.25f};
    const double dt = settings.time_step;
    const glm::dvec3 velocity{1.0, 3.0, -2.0};
    const glm::dvec3 gravity = settings.gravity;

    reference::Reference solver(groom, settings, 1);
    solver.setState(toDouble(groom.points), comingFrom(groom, velocity, dt));
    const glm::dvec3 start = solver.positions()[1];
    for (int n = 1; n <= 200; ++n) {
        solver.step();
        const glm::dvec3 expected =
            start + n * dt * velocity + n * (n + 1) / 2.0 * dt * dt * gravity;
        ASSERT_LT(glm::distance(solver.positions()[1], expected), 1e-10) << n;
    }
}

// With q = 1 - friction of the velocity kept, the displacements are d_m = q^m d_0 + a (1 - q^m) /
// (1 - q), a = g dt^2. X_n is their sum.
TEST(Verlet, LosesVelocityInAGeometricSeries) {
    const groom::Groom groom = straightGroom(1, 2);
    SimulationSettings settings = nothingActs();
    settings.stiffness_scaling = StiffnessScaling::thesis;
    settings.gravity = {0.0f, -9.8f, 0.0f};
    settings.friction = 0.25f;
    const double dt = settings.time_step;
    const glm::dvec3 velocity{2.0, 1.0, 0.0};
    const glm::dvec3 pull = glm::dvec3(settings.gravity) * dt * dt;

    reference::Reference solver(groom, settings, 1);
    solver.setState(toDouble(groom.points), comingFrom(groom, velocity, dt));
    const glm::dvec3 start = solver.positions()[1];
    const double q = 0.75;
    for (int n = 1; n <= 200; ++n) {
        solver.step();
        const double sum = q * (1.0 - std::pow(q, n)) / (1.0 - q);
        const glm::dvec3 expected = start + sum * velocity * dt + (n - sum) / (1.0 - q) * pull;
        ASSERT_LT(glm::distance(solver.positions()[1], expected), 1e-10) << n;
    }
}

TEST(Verlet, LeavesTheRootWhereItRests) {
    const groom::Groom groom = wavyGroom(3, 5);
    SimulationSettings settings;
    settings.wind.strength = 50.0f;
    reference::Reference solver(groom, settings, 1);
    for (int i = 0; i < 50; ++i) solver.step();
    for (std::uint32_t s = 0; s < 3; ++s)
        EXPECT_EQ(solver.positions()[5 * s], glm::dvec3(groom.strand(s)[0]));
}

// The fixed point of the pull under a constant acceleration a is off by a dt^2 (1 - k) / k.
TEST(GlobalConstraint, BalancesGravityWhereTheorySays) {
    const groom::Groom groom = straightGroom(1, 3);
    SimulationSettings settings = nothingActs();
    settings.stiffness_scaling = StiffnessScaling::thesis;
    settings.gravity = {0.0f, -9.8f, 0.0f};
    settings.friction = 0.05f;
    settings.global.stiffness = 0.125f;
    reference::Reference solver(groom, settings, 1);
    for (int i = 0; i < 2000; ++i) solver.step();
    const double dt = settings.time_step;
    const double sag = double{settings.gravity.y} * dt * dt * (1.0 - 0.125) / 0.125;
    for (std::size_t i = 1; i < 3; ++i)
        EXPECT_NEAR(solver.positions()[i].y - double{groom.points[i].y}, sag, 1e-12);
}

// In invariant scaling that is g h0^2 (1 - k) / k at any time step.
TEST(GlobalConstraint, BalancesGravityInTheSamePlaceAtEveryStep) {
    const groom::Groom groom = straightGroom(1, 2);
    SimulationSettings settings = nothingActs();
    settings.gravity = {0.0f, -9.8f, 0.0f};
    settings.friction = 0.05f;
    settings.global.stiffness = 0.125f;
    const double sag = double{settings.gravity.y} / 3600.0 * (1.0 - 0.125) / 0.125;
    for (const float step : {0.1f, 1.0f / 30.0f, 1.0f / 144.0f, 0.0005f}) {
        settings.time_step = step;
        reference::Reference solver(groom, settings, 1);
        const int steps = static_cast<int>(30.0f / step);
        for (int i = 0; i < steps; ++i) solver.step();
        // After 30 s at 0.95 per 1/60 s less than 1e-20 of the swing is left.
        EXPECT_NEAR(solver.positions()[1].y - double{groom.points[1].y}, sag, 1e-10) << step;
    }
}

TEST(GlobalConstraint, RestoresRestAtStiffnessOne) {
    const groom::Groom groom = wavyGroom(2, 6);
    SimulationSettings settings = nothingActs();
    settings.global.stiffness = 1.0f;
    reference::Reference solver(groom, settings, 1);
    const auto state = toDouble(disturbed(groom, 0.01, 3));
    solver.setState(state, state);
    solver.step();
    EXPECT_LT(largestDifference(solver.positions(), groom.points), 1e-15);
}

}  // namespace
}  // namespace hair::simulation
