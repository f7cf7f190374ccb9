#include "hair/simulation/solver_rod.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "hair/reference/rod.h"
#include "tests/largest_difference.h"
#include "tests/simulation/rods.h"
#include "tests/simulation/strands.h"

namespace hair::simulation {
namespace {

// Returns hair of the default material under gravity, in SI units.
HangingRod hanging(const std::vector<glm::dvec3>& points, double ellipticity = 1.0) {
    const reference::RodRest rest = reference::makeRodRest(points, {.ellipticity = ellipticity});
    HangingRod rod{
        .orientations = rest.orientations,
        .edges = {},
        .weights = {},
        .bend_stiffness = rest.bend_stiffness,
        .twist_stiffness = rest.twist_stiffness,
        .ellipticity = ellipticity};
    for (std::size_t i = 0; i < points.size(); ++i) {
        rod.edges.push_back(i > 0 ? points[i] - points[i - 1] : glm::dvec3(0.0));
        rod.weights.emplace_back(0.0, -kEarth * rest.masses[i], 0.0);
    }
    return rod;
}

std::vector<glm::dvec3> wavyRod(std::uint32_t seed, int vertices, double segment) {
    std::mt19937 random(seed);
    glm::dvec3 direction = glm::normalize(randomVector(random) + glm::dvec3(0.0, 0.01, 0.0));
    std::vector<glm::dvec3> points{glm::dvec3(0.0)};
    for (int i = 1; i < vertices; ++i) {
        points.push_back(points.back() + segment * direction);
        direction = glm::normalize(direction + 0.3 * randomVector(random));
    }
    return points;
}

// Every joint's torque, by the reference in double precision, balances the moment of the weights
// below. The rest rotations are solved to 1e-13. A joint that is stiffer than its moment by 10^3
// makes 1e-10 from that.
TEST(RodBalance, JointsBearTheWeightBelow) {
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        const std::vector<glm::dvec3> points = wavyRod(seed, 12, 0.01);
        const HangingRod rod = hanging(points, seed % 2 == 0 ? 1.0 : 1.8);
        const auto balanced = balanceRod(rod, 64.0);
        ASSERT_TRUE(balanced) << seed;
        ASSERT_EQ(balanced->half_rotations.size(), points.size());
        for (std::size_t i = 1; i < points.size(); ++i) {
            glm::dvec3 moment(0.0);
            for (std::size_t below = i; below < points.size(); ++below)
                moment += glm::cross(points[below] - points[i - 1], rod.weights[below]);
            const glm::dquat& half = balanced->half_rotations[i];
            const reference::Joint joint = reference::bendAndTwist(
                rod.orientations[i - 1] * half, rod.orientations[i] * glm::conjugate(half),
                balanced->stiffening * rod.bend_stiffness[i],
                balanced->stiffening * rod.twist_stiffness[i],
                i == 1 ? reference::Clamp::yes : reference::Clamp::no, rod.ellipticity);
            EXPECT_LT(glm::length(joint.torque + moment), 1e-9 * glm::length(moment) + 1e-20)
                << seed << ' ' << i;
        }
    }
}

// A clamped upright rod buckles under its own weight at lambda g L^3 / (E I) = 9/4 j^2 = 7.837,
// where j = 1.8664 is the first root of the Bessel function of order -1/3 (Greenhill 1881,
// Determination of the greatest height consistent with stability). Loads have a margin and
// stiffening has a precision; 64 segments are within 1 % of a rod.
TEST(RodBalance, AStandingRodIsStiffenedToGreenhillsBound) {
    constexpr double kBound = 7.837;
    for (const double gamma : {5.0, 7.0, 20.0, 60.0}) {
        const auto rod = hanging(straightRod(64, lengthFor(gamma, {}), {0.0, 1.0, 0.0}));
        const auto balanced = balanceRod(rod, 16.0);
        ASSERT_TRUE(balanced) << gamma;
        const double least = kLoadMargin * gamma / kBound;
        if (least < 1.0) {
            EXPECT_EQ(balanced->stiffening, 1.0) << gamma;
            continue;
        }
        EXPECT_GT(balanced->stiffening, 0.99 * least) << gamma;
        EXPECT_LT(balanced->stiffening, 1.01 * 1.05 * least) << gamma;
        EXPECT_FALSE(balanceRod(rod, 0.98 * least)) << gamma;
    }
}

// A rod with an elliptic section buckles along the shorter axis, at a load smaller by the
// ellipticity.
TEST(RodBalance, AFlatStandingRodIsStiffenedAlongItsShorterAxis) {
    constexpr double kBound = 7.837;
    constexpr double kEllipticity = 1.8;
    const auto rod = hanging(straightRod(64, lengthFor(7.0, {}), {0.0, 1.0, 0.0}), kEllipticity);
    const auto balanced = balanceRod(rod, 16.0);
    ASSERT_TRUE(balanced);
    const double least = kLoadMargin * 7.0 * kEllipticity / kBound;
    EXPECT_GT(balanced->stiffening, 0.99 * least);
    EXPECT_LT(balanced->stiffening, 1.01 * 1.05 * least);
}

TEST(RodBalance, AHangingRodNeedsNoStiffening) {
    for (const double gamma : {1.0, 1e3, 1e5}) {
        const auto balanced =
            balanceRod(hanging(straightRod(32, lengthFor(gamma, {}), {0.0, -1.0, 0.0})), 1.0);
        ASSERT_TRUE(balanced) << gamma;
        for (const glm::dquat& half : balanced->half_rotations)
            EXPECT_LT(glm::length(half - glm::dquat(1.0, 0.0, 0.0, 0.0)), 1e-12) << gamma;
    }
}

// The moment at a level rod's root, lambda g L^2 / 2, bends the clamp, half a joint, by the tangent
// of its angle. This is theory for one joint and independent of the rest of the rod.
TEST(RodBalance, NoJointBendsBeyondItsBound) {
    const auto points = straightRod(8, lengthFor(200.0, {}), {1.0, 0.0, 0.0});
    const HangingRod rod = hanging(points);
    double moment = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) moment -= points[i].x * rod.weights[i].y;
    const double least = moment / (rod.bend_stiffness[1] * std::tan(kMostBend / 2.0));
    ASSERT_GT(least, 1.5) << "the bound is for the clamp";
    EXPECT_FALSE(balanceRod(rod, 0.99 * least));
    EXPECT_FALSE(balanceRod(rod, 1.0));
    EXPECT_TRUE(balanceRod(rod, 100.0 * least));
}

TEST(RodBalance, TakesSegmentsWithoutLength) {
    auto points = straightRod(6, 0.05, {1.0, 0.0, 0.0});
    points.insert(points.begin() + 3, points[3]);
    EXPECT_TRUE(balanceRod(hanging(points), 16.0));
    EXPECT_TRUE(balanceRod(hanging(std::vector(4, glm::dvec3(1.0))), 16.0));
}

}  // namespace
}  // namespace hair::simulation
