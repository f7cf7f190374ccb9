#include "hair/reference/rod.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "benchmarks/physics/theory.h"
#include "tests/largest_difference.h"
#include "tests/simulation/rods.h"
#include "tests/simulation/strands.h"

namespace hair::reference {
namespace {

const glm::dvec3 kGravity(0.0, -simulation::kEarth, 0.0);

// A rod with its clamp and forces.
struct Rod {
    RodRest rest;
    RodState state;
    RodRoot root;
    glm::dvec3 gravity = kGravity;
    std::uint32_t iterations = 2;

    explicit Rod(const std::vector<glm::dvec3>& points, const RodMaterial& material = {})
        : rest(makeRodRest(points, material)), state(rodAtRest(rest)) {}

    void step(double time_step, double velocity_kept = 1.0) {
        const std::vector<glm::dvec3> accelerations(rest.points.size(), gravity);
        stepRod(state, rest, accelerations, root, time_step, velocity_kept, iterations);
    }
    // Takes long steps that keep half of each velocity. The longest rods here need some 35 of them.
    void comeToRest() {
        for (int i = 0; i < 60; ++i) step(0.1, 0.5);
    }
    double energy() const {
        double energy = rodEnergy(state, rest);
        const auto points = state.positions();
        for (std::size_t i = 1; i < points.size(); ++i)
            energy -= rest.masses[i] * glm::dot(gravity, points[i]);
        return energy;
    }
};

double hangingRatio(int segments, double gamma, double turn = 0.0) {
    const double length = simulation::lengthFor(gamma, {});
    Rod rod(
        turn == 0.0 ? simulation::straightRod(segments, length)
                    : simulation::arc(segments, length, turn));
    rod.comeToRest();
    return simulation::dropOverReach(rod.state.positions());
}

// Table of the curve of Romero et al. 2021 in this project's notes.
TEST(CantileverTheory, GivesThePublishedRatios) {
    const double table[][2] = {{0.1, 0.01250}, {1.0, 0.12456},  {5.0, 0.58572},   {10.0, 1.06680},
                               {50.0, 3.7056}, {100.0, 5.8881}, {1000.0, 21.335}, {10000.0, 69.71}};
    for (const auto& [gamma, ratio] : table)  // half of the last digit
        EXPECT_NEAR(benchmarks::physics::cantileverRatio(gamma) / ratio, 1.0, 1e-4) << gamma;
}

// Convergence is of second order: the error of 64 segments is 0.1 % or less, a twentieth of the
// requirement.
TEST(ReferenceRod, HangsAsACantileverDoes) {
    for (const double gamma : {0.1, 1.0, 5.0, 10.0, 50.0, 100.0, 1000.0}) {
        const double theory = benchmarks::physics::cantileverRatio(gamma);
        EXPECT_NEAR(hangingRatio(64, gamma) / theory, 1.0, 0.001) << gamma;
    }
}

TEST(ReferenceRod, ErrsByTheSquareOfTheSegmentLength) {
    for (const double gamma : {1.0, 10.0, 100.0}) {
        const double theory = benchmarks::physics::cantileverRatio(gamma);
        double coarser = 0.0;
        for (const int segments : {8, 16, 32, 64, 128}) {
            const double error = std::abs(hangingRatio(segments, gamma) / theory - 1.0);
            // The error shrinks to a quarter each time. Between 8 and 16 segments the next order
            // still matters.
            if (segments > 8) {
                EXPECT_LT(error, 0.55 * coarser) << gamma << " " << segments;
            }
            if (segments > 16) {
                EXPECT_NEAR(error / coarser, 0.25, 0.05) << gamma;
            }
            coarser = error;
        }
        EXPECT_LT(coarser, 1e-4) << gamma;  // with 128 segments
    }
}

// The natural curvature enters only at the free end.
TEST(ReferenceRod, HangsFromItsNaturalCurve) {
    for (const double turn : {-2.0, -1.0, 1.0, 2.0}) {
        const double theory = benchmarks::physics::cantileverRatio(10.0, turn);
        EXPECT_NEAR(hangingRatio(64, 10.0, turn) / theory, 1.0, 0.005) << turn;
    }
}

// A level arm across the end of a level shaft twists the shaft by M (a - l / 2) / (G J) up to the
// middle of its last segment, M = lambda g b^2 / 2. The rod is so light that nothing bends: bending
// changes the lever of the weight only to second order.
TEST(ReferenceRod, TwistsByItsTorsionalStiffness) {
    constexpr int kShaft = 24, kArm = 8;
    constexpr double kLength = 5e-4;
    std::vector<glm::dvec3> points = simulation::straightRod(kShaft, kLength * kShaft);
    for (int i = 1; i <= kArm; ++i)
        points.push_back(points[kShaft] + kLength * i * glm::dvec3(0.0, 0.0, 1.0));
    const RodMaterial material;
    Rod rod(points, material);
    rod.comeToRest();

    const glm::dquat turn =
        rod.state.orientations[kShaft] * glm::conjugate(rod.rest.orientations[kShaft]);
    const double arm = kArm * kLength;
    const double moment = simulation::lineDensity(material) * simulation::kEarth * arm * arm / 2.0;
    const double theory =
        moment * (kShaft - 0.5) * kLength / simulation::twistingStiffness(material);
    ASSERT_LT(theory, 1e-2);
    EXPECT_NEAR(2.0 * turn.x / theory, 1.0, 1e-3);
}

// Returns the time from a zero of the tip's height to the next but one. Steps are small: implicit
// Euler slows an oscillation by (w h)^2 / 3, 1e-5 here, and 64 segments slow it by about 1e-3.
double periodOfTip(Rod& rod, double time_step, int axis) {
    std::vector<double> crossings;
    double last = rod.state.positions().back()[axis];
    for (int i = 1; crossings.size() < 3 && i < 100000; ++i) {
        rod.step(time_step);
        const double now = rod.state.positions().back()[axis];
        if ((last > 0.0) != (now > 0.0)) crossings.push_back(time_step * (i - now / (now - last)));
        last = now;
    }
    return crossings.size() == 3 ? crossings[2] - crossings[0] : 0.0;
}

// The frequency is 1.8751^2 / (2 pi) sqrt(E I / (lambda L^4)), where cos z cosh z = -1 at z =
// 1.8751.
TEST(ReferenceRod, VibratesAtItsFirstFrequency) {
    constexpr double kZ = 1.87510406871196, kLength = 0.05;
    const RodMaterial material;
    const double frequency = kZ * kZ / (2.0 * simulation::kPi) *
                             std::sqrt(
                                 simulation::bendingStiffness(material) /
                                 simulation::lineDensity(material) / std::pow(kLength, 4.0));

    const auto rest = simulation::straightRod(64, kLength);
    auto bent = rest;
    for (auto& point : bent) {
        const double z = kZ * point.x / kLength;
        const double ratio = (std::cos(kZ) + std::cosh(kZ)) / (std::sin(kZ) + std::sinh(kZ));
        point.y = 1e-4 * (std::cosh(z) - std::cos(z) - ratio * (std::sinh(z) - std::sin(z)));
    }
    Rod rod(rest, material);
    rod.gravity = glm::dvec3(0.0);
    const double time_step = 1.0 / frequency / 1000.0;
    rod.state = rodFrom(rod.rest, bent, bent, time_step);
    EXPECT_NEAR(frequency * periodOfTip(rod, time_step, 1), 1.0, 0.005);
}

// With almost no stiffness the period is the chain's, 5.2255 sqrt(L / g), D. Bernoulli 1738. The
// shape is that of the first mode, J0(j sqrt(z / L)) at the height z above the tip.
TEST(ReferenceRod, SwingsAsAChainWhereItIsLimp) {
    constexpr double kLength = 0.2, kZero = 2.40482555769577;
    const auto rest = simulation::straightRod(64, kLength, {0.0, -1.0, 0.0});
    auto swung = rest;
    for (auto& point : swung)
        point.x = 1e-4 * std::cyl_bessel_j(0.0, kZero * std::sqrt(1.0 + point.y / kLength));
    Rod rod(rest, {.youngs_modulus = 1.0, .shear_modulus = 1.0});
    const double period = 5.2255 * std::sqrt(kLength / simulation::kEarth);
    rod.state = rodFrom(rod.rest, swung, swung, period / 1000.0);
    EXPECT_NEAR(periodOfTip(rod, period / 1000.0, 0) / period, 1.0, 0.005);
}

// Both ends are held. The stiffness of a limp hair at its ends and the yielding of the pin, a
// hundredth of g h^2, are below 1e-3.
TEST(ReferenceRod, HangsAsACatenaryBetweenItsRootAndAPin) {
    constexpr int kSegments = 64;
    constexpr double kLength = 0.2, kSpan = 0.14;
    Rod rod(
        simulation::straightRod(kSegments, kLength, {0.0, -1.0, 0.0}),
        {.youngs_modulus = 1e5, .shear_modulus = 1e5});
    const auto start = simulation::vee(kSegments, kLength, kSpan);
    rod.state = rodFrom(rod.rest, start, start, 1.0 / 60.0);
    rod.state.pins[kSegments] = start.back();
    for (int i = 0; i < 600; ++i) rod.step(1.0 / 60.0, 0.9);
    Extremes heights;
    for (const auto& point : rod.state.positions()) heights.add(point.y);
    EXPECT_NEAR(-heights.least() / simulation::catenarySag(kLength, kSpan), 1.0, 2e-3);
    EXPECT_LT(glm::distance(rod.state.positions().back(), start.back()), 1e-4);
}

TEST(ReferenceRod, StaysAtRestWithoutWeight) {
    Rod rod(simulation::helix(40, 0.005, 0.01, 4.0));
    rod.gravity = glm::dvec3(0.0);
    for (int i = 0; i < 200; ++i) rod.step(1.0 / 60.0);
    EXPECT_LT(largestDifference(rod.state.positions(), rod.rest.points), 1e-12);
}

// A rigid motion of the follicle leaves the rod's shape alone if nothing else acts.
TEST(ReferenceRod, FollowsItsFollicle) {
    Rod rod(simulation::helix(40, 0.005, 0.01, 4.0));
    rod.gravity = glm::dvec3(0.0);
    for (int i = 1; i <= 40; ++i) {
        rod.root.rotation = glm::angleAxis(0.05 * i, glm::normalize(glm::dvec3(1.0, 2.0, -0.5)));
        rod.root.translation = 0.002 * i * glm::dvec3(1.0, 0.0, 2.0);
        rod.step(1.0 / 60.0, 0.9);
        const glm::dvec3 root = rod.root.rotation * rod.rest.points[0] + rod.root.translation;
        ASSERT_EQ(rod.state.positions()[0], root);
    }
    rod.comeToRest();
    std::vector<glm::dvec3> expected;
    for (const auto& point : rod.rest.points)
        expected.push_back(rod.root.rotation * point + rod.root.translation);
    EXPECT_LT(largestDifference(rod.state.positions(), expected), 1e-9);
}

// Implicit Euler only takes energy away. Few iterations come within some 1e-8 of the present
// energy, and eight within rounding.
TEST(ReferenceRod, NeverGainsEnergy) {
    for (const double youngs_modulus : {1e3, 3.9e9, 1e12})
        for (const double time_step : {1.0 / 60.0, 1.0 / 1000.0})
            for (const std::uint32_t iterations : {1u, 2u, 8u}) {
                Rod rod(
                    simulation::helix(32, 0.01, 0.03, 3.0),
                    {.youngs_modulus = youngs_modulus, .shear_modulus = youngs_modulus / 6.0});
                rod.gravity = {simulation::kEarth, -simulation::kEarth, 0.0};
                rod.iterations = iterations;
                double mass = 0.0;
                for (const double m : rod.rest.masses) mass += m;
                const double left =
                    (iterations < 8 ? 1e-6 : 1e-10) * mass * simulation::kEarth * 0.1;
                double before = rod.energy();
                for (int i = 0; i < 500; ++i) {
                    rod.step(time_step);
                    const double now = rod.energy();
                    ASSERT_LE(now, before + left)
                        << youngs_modulus << " " << time_step << " " << iterations << " " << i;
                    before = now;
                }
            }
}

// Every kind of degenerate rod under every extreme stays finite and is never stretched.
TEST(ReferenceRod, EnduresDegenerateInput) {
    std::mt19937 random(4);
    for (int shape = 0; shape < 6; ++shape) {
        std::vector<glm::dvec3> points{glm::dvec3(0.0)};
        for (int i = 0; i < 16; ++i) {
            glm::dvec3 edge = 0.01 * glm::normalize(simulation::randomVector(random));
            if (shape == 1 && i % 3 == 1) edge = glm::dvec3(0.0);
            if (shape == 2) edge = glm::dvec3(0.0);
            if (shape == 3) edge = {0.0, i % 2 == 0 ? 0.01 : -0.01, 0.0};
            if (shape == 4 && i > 3 && i < 9) edge *= 1e-7;
            if (shape == 5 && i % 2 == 0) edge *= 1e-3;
            points.push_back(points.back() + edge);
        }
        for (const double youngs_modulus : {1.0, 3.9e9, 1e12})
            for (const double time_step : {0.0005, 1.0 / 60.0, 0.1})
                for (const double acceleration : {0.0, simulation::kEarth, 1e5}) {
                    Rod rod(
                        points,
                        {.youngs_modulus = youngs_modulus, .shear_modulus = youngs_modulus / 6.0});
                    auto start = points;
                    for (std::size_t i = 1; i < start.size(); ++i)
                        start[i] = i % 2 == 0 ? start[0]
                                              : points[i] + 0.05 * simulation::randomVector(random);
                    rod.state = rodFrom(rod.rest, start, points, time_step);
                    for (int i = 0; i < 50; ++i) {
                        rod.gravity = {0.0, i < 25 ? -acceleration : acceleration, acceleration};
                        rod.root.rotation = glm::angleAxis(0.3 * i, glm::dvec3(0.0, 0.6, 0.8));
                        rod.root.translation = {0.1 * i, 0.0, 0.0};
                        rod.step(time_step);
                    }
                    for (std::size_t i = 1; i < points.size(); ++i) {
                        const double length = glm::length(rod.state.edges[i]);
                        ASSERT_NEAR(length, rod.rest.lengths[i], 1e-12) << shape;
                        ASSERT_TRUE(std::isfinite(glm::length(rod.state.velocities[i])));
                        ASSERT_TRUE(std::isfinite(glm::length(rod.state.angular_velocities[i])));
                    }
                }
    }
}

}  // namespace
}  // namespace hair::reference
