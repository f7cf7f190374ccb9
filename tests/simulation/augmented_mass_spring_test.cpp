#include "hair/reference/augmented_mass_spring.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/largest_difference.h"
#include "tests/simulation/rods.h"

// The equations of `augmented_mass_spring` against the statics of its springs; gpu_rod_test.cpp
// holds the device against the reference.
namespace hair::reference {
namespace {

constexpr double kEnough =
    1.0;  // N, E A: hair of a few centimetres then stretches by less than 1e-6

// At rest under its weight. A swing of the softest spring here, 20 rad/s, loses 1e-8 of itself in
// the steps it is given.
RodState
restedSprings(const RodRest& rest, AugmentedMassSpringParameters parameters, int steps = 2000) {
    parameters.substep = 1e-3;
    parameters.velocity_kept = 0.98;
    parameters.iterations = 6;  // two leave 1e-7 of strain, which springs as stiff as these resist
    RodState state = rodAtRest(rest);
    const std::vector<glm::dvec3> accelerations(
        rest.points.size(), {0.0, -simulation::kEarth, 0.0});
    for (int i = 0; i < steps; ++i)
        stepAugmentedMassSpring(state, rest, accelerations, {}, parameters);
    return state;
}

// A segment of the mass m = lambda l / 2 at its end: the couple lambda kappa_a l angle against its
// weight, m g l cos(angle), so that 2 kappa_a angle = g l cos(angle).
TEST(ReferenceAugmentedMassSpring, HoldsASingleSegmentUpByItsAngle) {
    const RodMaterial material;
    const double line_density = simulation::lineDensity(material);
    for (const double length : {0.01, 0.05}) {
        const double stiffness = 0.2;  // m^2/s^2
        const RodRest rest = makeRodRest(simulation::straightRod(1, length), material);
        const RodState state = restedSprings(
            rest, {.spring_stiffness = kEnough, .angular_stiffness = line_density * stiffness});
        double low = 0.0, high = 1.5;
        for (int i = 0; i < 60; ++i) {
            const double angle = (low + high) / 2.0;
            (2.0 * stiffness * angle < simulation::kEarth * length * std::cos(angle) ? low : high) =
                angle;
        }
        const glm::dvec3 expected = length * glm::dvec3(std::cos(low), -std::sin(low), 0.0);
        EXPECT_LT(glm::distance(state.positions()[1], expected), 1e-5 * length) << length;
    }
}

// Hair whose weight only integrity bears hangs below its ghost by less than g / kappa_I; a limp
// single segment from a root that it may not stretch from, at the angle whose cosine balances:
// m kappa_I (x - x_ghost) has the component along the arc m kappa_I l sin(angle), against
// m g cos(angle), so that tan(angle) = g / (kappa_I l).
TEST(ReferenceAugmentedMassSpring, IsDrawnToItsGhost) {
    constexpr double kLength = 0.03, kIntegrity = 400.0;  // m, 1/s^2
    const RodRest rest = makeRodRest(simulation::straightRod(1, kLength), {});
    const RodState state =
        restedSprings(rest, {.spring_stiffness = kEnough, .integrity = kIntegrity});
    const double angle = std::atan(simulation::kEarth / (kIntegrity * kLength));
    const glm::dvec3 expected = kLength * glm::dvec3(std::cos(angle), -std::sin(angle), 0.0);
    EXPECT_LT(glm::distance(state.positions()[1], expected), 1e-5 * kLength);
}

// Small deflections of many segments by the angular springs are those of a string under the tension
// lambda kappa_a: kappa_a y' = -g (L - x), y(L) = -g L^2 / (2 kappa_a). The weight of the last
// segment's half is at its end, so that n segments have that sum exactly; slopes up to 0.02 leave
// 1e-3 of it to the cosine, the arc and the springs against bending.
TEST(ReferenceAugmentedMassSpring, DeflectsAsAStringDoes) {
    constexpr double kLength = 0.05, kStiffness = 25.0;  // m, m^2/s^2
    const RodMaterial material;
    const RodRest rest = makeRodRest(simulation::straightRod(16, kLength), material);
    const RodState state = restedSprings(
        rest, {.spring_stiffness = kEnough,
               .angular_stiffness = simulation::lineDensity(material) * kStiffness});
    const double expected = -simulation::kEarth * kLength * kLength / (2.0 * kStiffness);
    EXPECT_NEAR(state.positions().back().y / expected, 1.0, 1e-3);
}

// A straight hair hung by its root: the springs over k segments have the strain of these, and bear
// E A of it each. At a segment n, counted from the tip as 0, the tension is the weight below; k
// springs over k segments cross a segment, fewer near the ends. Solved here as a linear system of
// its own, small strains: unknown are the segments' stretches.
TEST(ReferenceAugmentedMassSpring, StretchesByTheWeightBelow) {
    constexpr std::size_t kSegments = 3;
    constexpr double kLength = 0.09, kStiffness = 1e-3;  // m, N
    const RodMaterial material;
    const RodRest rest =
        makeRodRest(simulation::straightRod(kSegments, kLength, {0.0, -1.0, 0.0}), material);
    const RodState state = restedSprings(rest, {.spring_stiffness = kStiffness});
    const std::vector<glm::dvec3> positions = state.positions();
    // Strains s of the three segments. Tension across each: its own spring, those over two segments
    // that cover it, (s_i + s_j) / 2, and the one over three, their mean.
    const double segment = kLength / kSegments;
    std::vector<double> strain;
    for (std::size_t i = 1; i <= kSegments; ++i)
        strain.push_back(glm::distance(positions[i], positions[i - 1]) / segment - 1.0);
    const double all = (strain[0] + strain[1] + strain[2]) / 3.0;
    const double upper = (strain[0] + strain[1]) / 2.0;
    const double lower = (strain[1] + strain[2]) / 2.0;
    const double tensions[] = {
        strain[0] + upper + all, strain[1] + upper + lower + all, strain[2] + lower + all};
    for (std::size_t i = 0; i < kSegments; ++i) {
        const double below = (kSegments - static_cast<double>(i) - 0.5) * segment;
        const double weight = simulation::lineDensity(material) * below * simulation::kEarth;
        EXPECT_NEAR(kStiffness * tensions[i] / weight, 1.0, 1e-6) << i;
    }
}

// The ghost goes with the head, and without weight hair comes to where it is, twist and all.
TEST(ReferenceAugmentedMassSpring, TurnsWithItsHead) {
    const RodMaterial material;
    const RodRest rest = makeRodRest(simulation::helix(12, 0.01, 0.02, 2.0), material);
    RodState state = rodAtRest(rest);
    const RodRoot root{
        .rotation = glm::angleAxis(0.5, glm::dvec3(0.0, 1.0, 0.0)), .translation = {0.1, 0.0, 0.0}};
    const std::vector<glm::dvec3> none(rest.points.size(), glm::dvec3(0.0));
    for (int i = 0; i < 3000; ++i)
        stepAugmentedMassSpring(
            state, rest, none, root,
            {.substep = 1e-3,
             .velocity_kept = 0.98,
             .spring_stiffness = 1e-3,
             .integrity = 100.0,
             .angular_stiffness = simulation::lineDensity(material)});
    std::vector<glm::dvec3> expected;
    for (const glm::dvec3& point : rest.points)
        expected.push_back(root.rotation * point + root.translation);
    EXPECT_LT(largestDifference(state.positions(), expected), 1e-6);
}

// What it misses: without its ghost straight hair has no stiffness against bending to first order,
// for springs over two segments shorten by the square of an angle. A level hair then hangs straight
// down, whatever the springs.
TEST(ReferenceAugmentedMassSpring, StraightHairIsLimpWithoutItsGhost) {
    const RodRest rest = makeRodRest(simulation::straightRod(4, 0.02), {});
    const RodState state = restedSprings(rest, {.spring_stiffness = 1e-3}, 4000);
    const glm::dvec3 tip = state.positions().back();
    EXPECT_LT(tip.y, -0.0195);
}

}  // namespace
}  // namespace hair::reference
