#include <cmath>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "hair/reference/rod.h"
#include "tests/simulation/strands.h"

namespace hair::reference {
namespace {

const glm::dquat kNoTurn(1.0, 0.0, 0.0, 0.0);

glm::dquat about(const glm::dvec3& axis, double angle) { return glm::angleAxis(angle, axis); }

// The torque on the second frame is minus the gradient of the energy by its rotation. This holds
// for any two stiffnesses and any section, and also for bends with a linear torque and a fading
// twist. Central differences of 1e-5 rad leave 1e-10 of the third derivative, which is about 1e3
// near the fold.
TEST(RodJoint, TorqueIsTheGradientOfTheEnergy) {
    std::mt19937 random(5);
    for (const Clamp clamp : {Clamp::no, Clamp::yes})
        for (int i = 0; i < 200; ++i) {
            const glm::dquat first =
                about(glm::normalize(simulation::randomVector(random)), 1.0 + i);
            const glm::dvec3 bend_axis = glm::normalize(glm::dvec3(
                simulation::randomSigned(random), simulation::randomSigned(random), 0.0));
            const double bend = 2.9 * simulation::randomSigned(random);
            const double twist = 2.5 * simulation::randomSigned(random);
            const glm::dquat second =
                first * about(bend_axis, bend) * about({0.0, 0.0, 1.0}, twist);
            const double ellipticity = i % 2 == 0 ? 1.0 : 2.5;
            const auto joined = [&](const glm::dquat& turn) {
                return bendAndTwist(first, turn * second, 2.0, 0.7, clamp, ellipticity);
            };
            const Joint joint = joined(kNoTurn);
            for (int k = 0; k < 3; ++k) {
                constexpr double kStep = 1e-5;
                glm::dvec3 axis(0.0);
                axis[k] = 1.0;
                const double more = joined(about(axis, kStep)).energy;
                const double less = joined(about(axis, -kStep)).energy;
                EXPECT_NEAR(joint.torque[k], -(more - less) / (2.0 * kStep), 1e-6)
                    << "bend " << bend << " twist " << twist;
            }
        }
}

// The torque is 2 K tan(b / 2). A clamp is half a joint: it has half of the torque of a whole joint
// at twice the angle, with the same K, which is K tan b.
TEST(RodJoint, BendsAsTheDiscreteElastica) {
    for (const double angle : {1e-6, 0.1, 0.5, 1.0}) {
        const glm::dquat bent = about({0.0, 1.0, 0.0}, angle);
        EXPECT_NEAR(
            bendAndTwist(kNoTurn, bent, 3.0, 1.0, Clamp::no).torque.y, -6.0 * std::tan(angle / 2.0),
            1e-12);
        EXPECT_NEAR(
            bendAndTwist(kNoTurn, bent, 3.0, 1.0, Clamp::yes).torque.y, -3.0 * std::tan(angle),
            1e-12);
    }
}

// The second moments of an ellipse of ratio e are e and 1 / e times that of the circle with the
// same area. About an axis between the two, bending would cause twist; halfway, the factor is e / 2
// + 1 / 2 e.
TEST(RodJoint, BendsAlongTheShorterAxisMoreEasily) {
    constexpr double kEllipticity = 1.8;
    for (const double angle : {1e-6, 0.1, 1.0})
        for (const auto& [axis, factor] :
             {std::pair{glm::dvec3(1.0, 0.0, 0.0), kEllipticity},
              {{0.0, 1.0, 0.0}, 1.0 / kEllipticity},
              {glm::normalize(glm::dvec3(1.0, 1.0, 0.0)),
               (kEllipticity + 1.0 / kEllipticity) / 2.0}})
            EXPECT_NEAR(
                glm::dot(
                    axis,
                    bendAndTwist(kNoTurn, about(axis, angle), 3.0, 1.0, Clamp::no, kEllipticity)
                        .torque),
                -6.0 * factor * std::tan(angle / 2.0), 1e-12);
}

TEST(RodJoint, TwistsLinearly) {
    for (const double angle : {-3.0, -0.1, 1e-6, 1.0, 3.0})
        EXPECT_NEAR(
            bendAndTwist(kNoTurn, about({0.0, 0.0, 1.0}, angle), 3.0, 2.0, Clamp::no).torque.z,
            -2.0 * angle, 1e-12);
}

// For small rotations the stiffness is the second derivative of the energy: K across the axis and
// K' along it.
TEST(RodJoint, IsStiffAsItsMaterialIs) {
    const glm::dmat3 stiffness = bendAndTwist(kNoTurn, kNoTurn, 3.0, 2.0, Clamp::no).stiffness;
    EXPECT_EQ(stiffness, (glm::dmat3{{3.0, 0.0, 0.0}, {0.0, 3.0, 0.0}, {0.0, 0.0, 2.0}}));
}

TEST(RodJoint, StaysFiniteWhereAxesAreOpposite) {
    for (const glm::dvec3& axis : {glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.6, 0.8, 0.0)})
        for (const Clamp clamp : {Clamp::no, Clamp::yes}) {
            const Joint joint = bendAndTwist(kNoTurn, glm::dquat(0.0, axis), 3.0, 2.0, clamp);
            EXPECT_TRUE(std::isfinite(joint.energy));
            EXPECT_GT(glm::dot(joint.torque, -axis), 3.0);  // unfolds
        }
}

TEST(RodJoint, TurnsBetweenAnyTwoVectorsAndHalfWay) {
    std::mt19937 random(3);
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 from = glm::normalize(simulation::randomVector(random));
        const glm::dvec3 to = i % 3 == 0 ? -from : glm::normalize(simulation::randomVector(random));
        const glm::dquat turn = rotationBetween(from, to);
        EXPECT_LT(glm::distance(turn * from, to), 1e-12);
        const glm::dquat half = halfOf(turn);
        EXPECT_LT(glm::distance(half * (half * from), to), 1e-12);
    }
}

}  // namespace
}  // namespace hair::reference
