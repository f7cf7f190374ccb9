#include "hair/reference/compared_rods.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/largest_difference.h"
#include "tests/simulation/rods.h"

// Tests the equations of `augmented_mass_spring` against the statics of its springs.
// gpu_rod_test.cpp compares the device with the reference.
namespace hair::reference {
namespace {

constexpr double kEnough =
    1.0;  // N, E A: hair of a few centimetres then stretches by less than 1e-6

// Returns the rod at rest under its weight. A swing of the softest spring here, 20 rad/s, decays to
// 1e-8 of itself in the default steps.
RodState
restedSprings(const RodRest& rest, AugmentedMassSpringParameters parameters, int steps = 2000) {
    parameters.substep = 1e-3;
    parameters.velocity_kept = 0.98;
    parameters.iterations = 6;  // two leave a strain of 1e-7, which such stiff springs resist
    RodState state = rodAtRest(rest);
    const std::vector<glm::dvec3> accelerations(
        rest.points.size(), {0.0, -simulation::kEarth, 0.0});
    for (int i = 0; i < steps; ++i)
        stepAugmentedMassSpring(state, rest, accelerations, {}, parameters);
    return state;
}

// The mass m = lambda l / 2 is at the segment's end. The couple lambda kappa_a l angle balances its
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

// A limp single segment, with a root that it can't stretch from, hangs below its ghost. Only
// integrity bears its weight: m kappa_I (x - x_ghost) has the component m kappa_I l sin(angle)
// along the arc, which balances m g cos(angle), so that tan(angle) = g / (kappa_I l).
TEST(ReferenceAugmentedMassSpring, IsDrawnToItsGhost) {
    constexpr double kLength = 0.03, kIntegrity = 400.0;  // m, 1/s^2
    const RodRest rest = makeRodRest(simulation::straightRod(1, kLength), {});
    const RodState state =
        restedSprings(rest, {.spring_stiffness = kEnough, .integrity = kIntegrity});
    const double angle = std::atan(simulation::kEarth / (kIntegrity * kLength));
    const glm::dvec3 expected = kLength * glm::dvec3(std::cos(angle), -std::sin(angle), 0.0);
    EXPECT_LT(glm::distance(state.positions()[1], expected), 1e-5 * kLength);
}

// Under small deflections, the angular springs of many segments act like a string under the tension
// lambda kappa_a: kappa_a y' = -g (L - x), y(L) = -g L^2 / (2 kappa_a). Half of the last segment's
// weight is at its end, so that n segments have exactly this sum. With slopes up to 0.02, the
// cosine, the arc and the springs against bending make 1e-3 of it.
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

// A straight hair hangs by its root. Each spring over k segments has their mean strain and bears E
// A times it. The tension across a segment is the weight below its middle. Up to k springs over k
// segments cross a segment; near the ends there are fewer. Strains are small.
TEST(ReferenceAugmentedMassSpring, StretchesByTheWeightBelow) {
    constexpr std::size_t kSegments = 3;
    constexpr double kLength = 0.09, kStiffness = 1e-3;  // m, N
    const RodMaterial material;
    const RodRest rest =
        makeRodRest(simulation::straightRod(kSegments, kLength, {0.0, -1.0, 0.0}), material);
    const RodState state = restedSprings(rest, {.spring_stiffness = kStiffness});
    const std::vector<glm::dvec3> positions = state.positions();
    // Strains s of the three segments. The tension across each comes from its own spring, from
    // those over two segments that cover it, (s_i + s_j) / 2, and from the spring over all three,
    // with their mean.
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

// The ghost moves with the head. Without weight, hair comes to rest on it, including its twist.
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

// Limitation: without its ghost, straight hair has no stiffness against bending to first order,
// because springs over two segments shorten by the square of an angle. A level hair then hangs
// straight down with any springs.
TEST(ReferenceAugmentedMassSpring, StraightHairIsLimpWithoutItsGhost) {
    const RodRest rest = makeRodRest(simulation::straightRod(4, 0.02), {});
    const RodState state = restedSprings(rest, {.spring_stiffness = 1e-3}, 4000);
    const glm::dvec3 tip = state.positions().back();
    EXPECT_LT(tip.y, -0.0195);
}

}  // namespace
}  // namespace hair::reference
