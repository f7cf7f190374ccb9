#include "hair/reference/compared_rods.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "benchmarks/physics/theory.h"
#include "tests/largest_difference.h"
#include "tests/simulation/rods.h"

// Tests the equations of `position_based_rod` against theory, with enough iterations to solve them.
// gpu_rod_test.cpp compares the device with the reference.
namespace hair::reference {
namespace {

// Returns the rod at rest under its weight.
RodState restedRod(const RodRest& rest, const PositionBasedRodParameters& parameters, int steps) {
    RodState state = rodAtRest(rest);
    const std::vector<glm::dvec3> accelerations(
        rest.points.size(), {0.0, -simulation::kEarth, 0.0});
    for (int i = 0; i < steps; ++i)
        stepPositionBasedRod(state, rest, accelerations, {}, parameters);
    return state;
}

double stretchStiffness(const RodMaterial& material) {
    return material.youngs_modulus * simulation::kPi * material.radius * material.radius;
}

// A single segment under its weight has a mass of lambda l / 2 at its end. Im(r) is sin(angle / 2),
// so the clamp's torque is K sin(angle), K = 2 E I / l, and it bears m g l cos(angle). E A is so
// great that stretch is below 1e-6.
TEST(ReferencePositionBasedRod, HoldsASingleSegmentUp) {
    for (const double length : {0.005, 0.02, 0.05}) {
        const RodMaterial material;
        const RodRest rest = makeRodRest(simulation::straightRod(1, length), material);
        const double weight = simulation::lineDensity(material) * length / 2.0 * simulation::kEarth;
        const double stiffness = 2.0 * simulation::bendingStiffness(material) / length;
        const double angle = std::atan(weight * length / stiffness);
        const RodState state = restedRod(
            rest,
            {.substep = 1e-3,
             .velocity_kept = 0.97,
             .stretch_stiffness = stretchStiffness(material),
             .iterations = 100},
            3000);
        const glm::dvec3 expected = length * glm::dvec3(std::cos(angle), -std::sin(angle), 0.0);
        EXPECT_LT(glm::distance(state.positions()[1], expected), 1e-4 * length) << length;
    }
}

// With few segments and many iterations the solver converges to a rod. The error of six segments is
// of second order: less than 2 / 6^2.
TEST(ReferencePositionBasedRod, HangsAsACantileverDoesWhereItConverges) {
    const RodMaterial material;
    for (const double gamma : {1.0, 10.0}) {
        const RodRest rest = makeRodRest(
            simulation::straightRod(6, simulation::lengthFor(gamma, material)), material);
        const RodState state = restedRod(
            rest,
            {.substep = 1.0 / 480.0,
             .velocity_kept = 0.9,
             .stretch_stiffness = stretchStiffness(material),
             .iterations = 400},
            600);
        EXPECT_NEAR(
            simulation::dropOverReach(state.positions()) /
                benchmarks::physics::cantileverRatio(gamma),
            1.0, 2.0 / 36.0)
            << gamma;
    }
}

// A level arm across the end of a level shaft twists the shaft by M (a - l / 2) / (G J) up to the
// middle of its last segment, as in reference_rod_test.cpp.
TEST(ReferencePositionBasedRod, TwistsByItsTorsionalStiffness) {
    constexpr int kShaft = 3, kArm = 2;
    constexpr double kLength = 2e-3;
    std::vector<glm::dvec3> points = simulation::straightRod(kShaft, kLength * kShaft);
    for (int i = 1; i <= kArm; ++i)
        points.push_back(points[kShaft] + kLength * i * glm::dvec3(0.0, 0.0, 1.0));
    const RodMaterial material;
    const RodRest rest = makeRodRest(points, material);
    const RodState state = restedRod(
        rest,
        {.substep = 2e-4,
         .velocity_kept = 0.9,
         .stretch_stiffness = stretchStiffness(material),
         .iterations = 300},
        1000);
    const glm::dquat turn = state.orientations[kShaft] * glm::conjugate(rest.orientations[kShaft]);
    const double arm = kArm * kLength;
    const double moment = simulation::lineDensity(material) * simulation::kEarth * arm * arm / 2.0;
    const double theory =
        moment * (kShaft - 0.5) * kLength / simulation::twistingStiffness(material);
    ASSERT_LT(theory, 1e-2);
    EXPECT_NEAR(2.0 * turn.x / theory, 1.0, 0.01);
}

// Each segment of a hair that hangs by its root stretches by the weight below it over E A. With
// such short substeps fifty sweeps leave less than 1e-7.
TEST(ReferencePositionBasedRod, StretchesByTheWeightBelow) {
    constexpr int kSegments = 10;
    constexpr double kLength = 0.1, kStiffness = 1e-3;  // m, N
    const RodMaterial material;
    const RodRest rest =
        makeRodRest(simulation::straightRod(kSegments, kLength, {0.0, -1.0, 0.0}), material);
    const RodState state = restedRod(
        rest,
        {.substep = 2e-4,
         .velocity_kept = 0.995,
         .stretch_stiffness = kStiffness,
         .iterations = 50},
        5000);
    const std::vector<glm::dvec3> positions = state.positions();
    for (std::size_t i = 1; i <= kSegments; ++i) {
        const double below = (kSegments - static_cast<double>(i) + 0.5) * kLength / kSegments;
        const double strain =
            simulation::lineDensity(material) * below * simulation::kEarth / kStiffness;
        EXPECT_NEAR(
            glm::distance(positions[i], positions[i - 1]) * kSegments / kLength, 1.0 + strain,
            1e-7);
    }
}

// The follicle turns about the hair's own axis, and nothing else acts: every segment comes to turn
// as far.
TEST(ReferencePositionBasedRod, TurnsWithItsClamp) {
    const RodMaterial material;
    const RodRest rest = makeRodRest(simulation::straightRod(4, 0.04, {0.0, -1.0, 0.0}), material);
    RodState state = rodAtRest(rest);
    const RodRoot root{
        .rotation = glm::angleAxis(0.5, glm::dvec3(0.0, 1.0, 0.0)), .translation = {}};
    const std::vector<glm::dvec3> none(5, glm::dvec3(0.0));
    for (int i = 0; i < 300; ++i)
        stepPositionBasedRod(
            state, rest, none, root,
            {.velocity_kept = 0.9, .stretch_stiffness = stretchStiffness(material)});
    for (std::size_t i = 0; i < 5; ++i) {
        const glm::dquat expected = root.rotation * rest.orientations[i];
        EXPECT_NEAR(std::abs(glm::dot(state.orientations[i], expected)), 1.0, 1e-6) << i;
    }
}

}  // namespace
}  // namespace hair::reference
