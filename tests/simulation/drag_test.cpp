#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "hair/reference/rod.h"
#include "hair/reference/solvers.h"
#include "hair/reference/wind.h"
#include "hair/simulation/forces.h"
#include "hair/simulation/solvers.h"
#include "tests/simulation/drag.h"
#include "tests/simulation/rods.h"
#include "tests/simulation/strands.h"

namespace hair::simulation {
namespace {

// Returns the tip's acceleration for one segment along z whose tip has the velocity `v`.
glm::dvec3 dragAtTip(const SimulationSettings& settings, const glm::dvec3& v) {
    const std::vector<glm::dvec3> positions{{0, 0, 0}, {0, 0, 0.1}};
    std::vector<glm::dvec3> previous = positions;
    for (glm::dvec3& point : previous) point -= v * double{settings.time_step};
    return dragOnFree(positions, previous, settings, 1)[1];
}

// Ratio of drag to weight for a hair of 70 um that moves across its axis in air: 3.9 at 1 m/s and
// 47 at 5 m/s, as published to two digits.
TEST(Drag, IsThatOfAThinCylinder) {
    const WindSettings air;
    const MaterialSettings hair{.density = 1320.0f, .radius = 35e-6f};
    EXPECT_NEAR(reference::dragAcceleration(air, hair, 1.0) / 9.81, 3.9, 0.05);
    EXPECT_NEAR(reference::dragAcceleration(air, hair, 5.0) / 9.81, 47.0, 0.5);
    EXPECT_EQ(reference::dragAcceleration(air, hair, 0.0), 0.0);
}

TEST(Drag, HasTheFactorsThatTheDeviceIsGiven) {
    for (const float density : {0.0f, 0.3f, 1.2f, 1000.0f})
        for (const float radius : {1e-6f, 37e-6f, 0.01f}) {
            const WindSettings air{.air_density = density, .air_viscosity = 5e-5f};
            const MaterialSettings hair{.density = 900.0f, .radius = radius};
            const DragFactors factors = dragFactors(air, hair);
            for (const double speed : {1e-6, 0.01, 1.0, 100.0}) {
                const double k = factors.inertial * speed + factors.viscous * std::cbrt(speed);
                const double expected = reference::dragAcceleration(air, hair, speed);
                EXPECT_NEAR(k * speed, expected, 1e-12 * expected);  // rounding of double
            }
        }
}

// A step multiplies the error by (1 - p k dt) / (1 + k dt), where p in [1/3, 1] is the exponent of
// k(u). That is less than 0.8 here, and its 60th power is 2e-6.
TEST(Drag, LetsHairFallAtTheSpeedWhereItBearsTheWeight) {
    for (const float step : {1.0f / 120.0f, 1.0f / 60.0f, 0.1f}) {
        const SimulationSettings settings = fallingThroughAir(step);
        reference::Reference solver(levelHair(), settings, 1);
        for (int i = 0; i < kFreeSteps; ++i) solver.step();
        const glm::dvec3 moved = solver.positions().back() - solver.previous().back();
        EXPECT_NEAR(-moved.y / double{step} / fallingSpeed(settings), 1.0, 5e-6) << step;
    }
}

// At any step, drag and gravity together point along k U + g for hair that is held.
TEST(Drag, KeepsProportionToGravityInHairThatIsHeld) {
    for (const float step : {0.0005f, 1.0f / 60.0f, 0.1f}) {
        SimulationSettings settings = inAir(step);
        settings.gravity = {0.0f, -9.8f, 0.0f};
        settings.wind.speed = 1.0f;
        const glm::dvec3 sum = dragAtTip(settings, glm::dvec3(0.0)) + glm::dvec3(settings.gravity);
        const double drag = reference::dragAcceleration(settings.wind, settings.material, 1.0);
        EXPECT_NEAR(sum.x / -sum.y, drag / double{9.8f}, 1e-12) << step;
    }
}

TEST(Drag, NeverTurnsTheRelativeVelocityRound) {
    for (const float step : {0.0005f, 0.1f})
        for (const float radius : {1e-6f, 37e-6f, 0.01f})
            for (const float speed : {0.001f, 1.0f, 100.0f}) {
                SimulationSettings settings = inAir(step);
                settings.material.radius = radius;
                settings.wind.speed = speed;
                const glm::dvec3 wind(speed, 0, 0);
                const glm::dvec3 v(0, 3, 0);
                const glm::dvec3 u = wind - v;
                const glm::dvec3 after = u - double{step} * dragAtTip(settings, v);
                EXPECT_GE(glm::dot(after, u), 0.0);
                EXPECT_LT(glm::length(glm::cross(after, u)), 1e-12 * glm::dot(u, u));
                EXPECT_LT(glm::length(after), glm::length(u));
            }
}

// du/dt = -c u^2 has the solution u / (1 + c u t), and a step computes exactly this.
TEST(Drag, IsExactWithoutViscosityAtAnyStep) {
    for (const float step : {0.0005f, 0.1f}) {
        SimulationSettings settings = inAir(step);
        settings.wind.air_viscosity = 0.0f;
        const double c = reference::dragAcceleration(settings.wind, settings.material, 1.0);
        glm::dvec3 v(8, 0, 0);
        for (int i = 0; i < 20; ++i) v += double{step} * dragAtTip(settings, v);
        const double expected = 8.0 / (1.0 + c * 8.0 * 20.0 * double{step});
        EXPECT_NEAR(v.x, expected, 1e-12) << step;
    }
}

// Compares with du/dt = -k(u) u, integrated to fourth order in steps of 1e-5 s. Half the step makes
// half the error.
TEST(Drag, IsOfFirstOrder) {
    SimulationSettings settings = inAir(0.1f);
    const auto slope = [&](double u) {
        return -reference::dragAcceleration(settings.wind, settings.material, u);
    };
    double exact = 5.0;
    for (int i = 0; i < 10000; ++i) {
        const double h = 1e-5;
        const double a = slope(exact);
        const double b = slope(exact + h / 2.0 * a);
        const double c = slope(exact + h / 2.0 * b);
        const double d = slope(exact + h * c);
        exact += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    }
    std::vector<double> errors;
    for (const int steps : {64, 128, 256}) {
        settings.time_step = 0.1f / static_cast<float>(steps);
        glm::dvec3 v(5, 0, 0);
        for (int i = 0; i < steps; ++i) v += double{settings.time_step} * dragAtTip(settings, v);
        errors.push_back(v.x - exact);
    }
    EXPECT_GT(errors[0], 0.0);  // it brakes too little
    // The second-order term is a few times dt k = 0.1 / 64 * 90 / 5, with a mean k.
    EXPECT_NEAR(errors[0] / errors[1], 2.0, 0.1);
    EXPECT_NEAR(errors[1] / errors[2], 2.0, 0.05);
}

TEST(Drag, IsNoneAlongTheHair) {
    SimulationSettings settings = inAir(0.01f);
    settings.wind.speed = 30.0f;
    settings.wind.direction = {0.3f, 0.5f, -0.7f};
    const glm::dvec3 along = glm::normalize(glm::dvec3(settings.wind.direction));
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 5; ++i) points.push_back(0.02 * i * along);
    for (const glm::dvec3& a : dragOnFree(points, points, settings, 1))
        // k is at most 4000/s, and rounding leaves a speed of 1e-16 of 30 m/s.
        EXPECT_LT(glm::length(a), 1e-10);
}

// At the vertices of a polygon in a circle, the circle's tangent lies halfway between the two
// sides.
TEST(Drag, TakesTheTangentOfTheCurveThroughTheVertices) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 4; ++i) points.emplace_back(std::cos(0.5 * i), std::sin(0.5 * i), 0.0);
    SimulationSettings settings = inAir(0.01f);
    settings.wind.speed = 5.0f;
    for (std::size_t i = 1; i < 3; ++i) {
        settings.wind.direction = {-points[i].y, points[i].x, 0.0};
        const auto a = dragOnFree(points, points, settings, 1);
        // The direction is a float: 6e-8 of 5 m/s remain across the hair, and k is below 100/s at
        // 1e-6 m/s.
        EXPECT_LT(glm::length(a[i]), 1e-5) << i;
        EXPECT_GT(glm::length(a[3]), 1.0);  // the tip has only the segment above
    }
}

TEST(Drag, StandsSegmentsWithoutADirectionAndFolds) {
    SimulationSettings settings = inAir(0.01f);
    settings.wind.speed = 5.0f;
    const std::vector<glm::dvec3> points{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, 0}};
    const auto a = dragOnFree(points, points, settings, 1);
    EXPECT_EQ(a[1], glm::dvec3(0.0));  // no direction above or below
    EXPECT_GT(a[2].x, 0.0);  // a direction below
    EXPECT_GT(a[3].x, 0.0);  // folded: takes the direction above
    EXPECT_GT(a[4].x, 0.0);
}

TEST(Drag, IsBorneByASpringAtAnyStep) {
    for (const float step : {1.0f / 480.0f, 1.0f / 60.0f, 0.1f})
        for (const std::uint32_t substeps : {1u, 4u})
            for (const Solver solver : {Solver::shape, Solver::ftl}) {
                const SimulationSettings settings = onSpring(solver, step, substeps);
                reference::Reference simulation(levelPair(), settings, 1);
                for (int i = 0; i < restingSteps(settings); ++i) simulation.step();
                EXPECT_NEAR(simulation.positions().back().z / springsStretch(settings), 1.0, 1e-4)
                    << static_cast<int>(solver) << ' ' << step << ' ' << substeps;
            }
}

// P is symmetric and positive semidefinite, so drag never adds energy: its power on the velocity at
// the end of a step is at most 0, however the rod is held. At first vertices move by a millimetre a
// step; segments are 6 mm long.
TEST(Drag, TakesEnergyFromRodsAtEveryStep) {
    for (const float step : {1.0f / 480.0f, 1.0f / 60.0f, 0.1f}) {
        const auto points = straightRod(16, 0.1);
        const reference::RodRest rest = reference::makeRodRest(points, {});
        const SimulationSettings settings = inAir(step);
        const std::vector<glm::dvec3> air(points.size(), glm::dvec3(0.0));
        const reference::RodAir still{
            .velocities = air, .rates = [&](auto tangents, auto velocities) {
                return reference::dragRates(tangents, velocities, air, settings);
            }};
        reference::RodState state = reference::rodAtRest(rest);
        std::mt19937 random(3);
        for (std::size_t i = 1; i < points.size(); ++i)
            state.velocities[i] = 0.001 / double{step} * randomVector(random);
        double first = 0.0;
        double before = std::numeric_limits<double>::infinity();
        for (int i = 0; i < 200; ++i) {
            reference::stepRod(
                state, rest, std::vector(points.size(), glm::dvec3(0.0)), {}, double{step}, 1.0, 8,
                &still);
            const double energy = reference::rodEnergy(state, rest);
            // Random velocities stretch the rod before the first step, and Newton's iterations
            // leave part of a step's change. The test ends at a billionth of the energy: below it,
            // at steps of 0.1 s, the energy was seen to rise, and more iterations do not change
            // that.
            if (i == 0) first = energy;
            if (energy < 1e-9 * first) break;
            EXPECT_LE(energy, before * (1.0 + 1e-6)) << step << ' ' << i;
            before = energy;
        }
        EXPECT_LT(before, 0.5 * first) << step;
    }
}

TEST(Drag, BrakesHairThatSettlesOutOfTheWind) {
    SimulationSettings settings = inAir(1.0f / 60.0f);
    settings.wind.speed = 10.0f;
    const groom::Groom groom = levelHair();
    reference::Reference solver(groom, settings, 1);
    const auto positions = toDouble(groom.points);
    auto previous = positions;
    for (glm::dvec3& point : previous) point.z -= 2.0 * double{settings.time_step};
    solver.setState(positions, previous);
    solver.settle();
    const glm::dvec3 v =
        (solver.positions().back() - positions.back()) / double{settings.time_step};
    const double k = reference::dragAcceleration(settings.wind, settings.material, 2.0) / 2.0;
    EXPECT_LT(
        glm::distance(v, glm::dvec3(0, 0, 2.0 / (1.0 + k * double{settings.time_step}))), 1e-9);
    EXPECT_EQ(solver.time(), 0.0);
}

}  // namespace
}  // namespace hair::simulation
