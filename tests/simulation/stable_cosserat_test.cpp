#include "hair/reference/compared_rods.h"

#include <cmath>
#include <random>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "benchmarks/physics/theory.h"
#include "hair/reference/solvers.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/simulation/gpu_simulation.h"
#include "tests/simulation/rods.h"
#include "tests/simulation/strands.h"

// Tests the equations of `stable_cosserat` against theory. gpu_rod_test.cpp compares the device
// with the reference.
namespace hair::reference {
namespace {

glm::dquat randomOrientation(std::mt19937& random) {
    glm::dquat q;
    do q = {simulation::randomSigned(random), simulation::randomVector(random)};
    while (glm::length(q) < 0.1);
    return glm::normalize(q);
}

glm::dvec3 lastAxis(const glm::dquat& q) { return q * glm::dvec3(0.0, 0.0, 1.0); }

double gainOf(const glm::dquat& q, const glm::dquat& b, const glm::dvec3& edge) {
    return glm::dot(q, b) + glm::dot(edge, lastAxis(q));
}

// Neither random orientations nor small turns of the result give a greater value. Rounding makes a
// difference of less than 1e-12 of both terms.
TEST(BalancedOrientation, IsTheGreatestOfAll) {
    std::mt19937 random(2);
    for (const double strength : {0.0, 1e-3, 0.3, 1.0, 5.0, 1e4})
        for (int i = 0; i < 50; ++i) {
            const glm::dquat b = 2.0 * randomOrientation(random);
            const glm::dvec3 edge = strength * glm::normalize(simulation::randomVector(random));
            const glm::dquat q = balancedOrientation(b, edge);
            EXPECT_NEAR(glm::length(q), 1.0, 1e-14);
            const double greatest = gainOf(q, b, edge) + 1e-12 * (1.0 + strength);
            for (int k = 0; k < 50; ++k) {
                const glm::dquat other = randomOrientation(random);
                EXPECT_LE(gainOf(other, b, edge), greatest) << strength;
                const glm::dquat near = glm::normalize(q + 1e-3 * other);
                EXPECT_LE(gainOf(near, b, edge), greatest) << strength;
            }
        }
}

// Compares with the closed form of Hsu et al. 2025, with the multiplier computed from the
// orientation: lambda = q . (b - v q e3), from lambda q = b - v q e3, v = -2 edge.
TEST(BalancedOrientation, IsThePublishedClosedForm) {
    std::mt19937 random(3);
    for (int i = 0; i < 100; ++i) {
        const glm::dquat b = 3.0 * randomOrientation(random);
        const glm::dvec3 edge = simulation::randomVector(random);
        const glm::dquat q = balancedOrientation(b, edge);
        const glm::dquat e3(0.0, 0.0, 0.0, 1.0);
        const glm::dquat v(0.0, -2.0 * edge);
        const double lambda = glm::dot(q, b + v * q * e3);
        EXPECT_GT(lambda, glm::length(v));
        const glm::dquat published = (v * b * e3 + lambda * b) / (lambda * lambda - glm::dot(v, v));
        EXPECT_NEAR(glm::length(published - q), 0.0, 1e-9);
    }
}

// The energy is K angle^2 / 2 with the stiffness for the axis of rotation. The next order is at
// most angle^4 / 48 of K, the greater of both stiffnesses.
TEST(StableCosseratJoint, BendsAndTwistsByTheMaterialsStiffness) {
    const RodRest rest = makeRodRest(simulation::helix(6, 0.01, 0.02, 0.4), {});
    const double angle = 1e-2;
    for (const std::size_t joint : {1u, 3u})
        for (int axis = 0; axis < 3; ++axis) {
            std::vector<glm::dquat> orientations = rest.orientations;
            EXPECT_NEAR(
                bendTwistEnergy(rest, orientations, joint) / rest.bend_stiffness[joint], 0.0,
                1e-14);
            // Turns about an axis of the frame in which both orientations agree at rest.
            const glm::dquat frame = orientations[joint - 1] * rest.half_rotations[joint];
            glm::dvec3 direction(0.0);
            direction[axis] = 1.0;
            orientations[joint] = glm::angleAxis(angle, frame * direction) * orientations[joint];
            const double stiffness =
                axis == 2 ? rest.twist_stiffness[joint] : rest.bend_stiffness[joint];
            const double expected = stiffness * angle * angle / 2.0;
            EXPECT_NEAR(
                bendTwistEnergy(rest, orientations, joint), expected,
                rest.bend_stiffness[joint] * std::pow(angle, 4.0) / 48.0)
                << joint << " " << axis;
        }
}

// Returns the energy that a step minimises, in J: distances of vertices from their predictions,
// stretch and shear, bend and twist.
double objective(
    const RodState& state, const RodRest& rest, std::span<const glm::dvec3> predicted,
    const StableCosseratParameters& parameters) {
    const std::vector<glm::dvec3> positions = state.positions();
    double energy = 0.0;
    for (std::size_t i = 1; i < positions.size(); ++i) {
        const glm::dvec3 ahead = positions[i] - predicted[i];
        energy += rest.masses[i] * glm::dot(ahead, ahead) /
                  (2.0 * parameters.substep * parameters.substep);
        const glm::dvec3 strain =
            (positions[i] - positions[i - 1]) / rest.lengths[i] - lastAxis(state.orientations[i]);
        energy += parameters.stretch_stiffness * rest.lengths[i] * glm::dot(strain, strain) / 2.0 +
                  bendTwistEnergy(rest, state.orientations, i);
    }
    return energy;
}

// For any stiffnesses and step, a further iteration never raises the energy, except by rounding.
TEST(ReferenceStableCosserat, LowersTheEnergyInEveryIteration) {
    std::mt19937 random(8);
    for (const double shear_modulus : {0.1e9, 2.0e9, 20.0e9})  // bend or twist is stiffer
        for (const double modulus : {1e4, 1e6, 1e9})
            for (const double substep : {1.0 / 960.0, 0.1}) {
                const RodMaterial material{.shear_modulus = shear_modulus};
                const RodRest rest = makeRodRest(simulation::helix(12, 0.01, 0.02, 1.5), material);
                RodState start = rodAtRest(rest);
                std::vector<glm::dvec3> accelerations(13);
                std::vector<glm::dvec3> predicted = start.positions();
                for (std::size_t i = 1; i < 13; ++i) {
                    start.velocities[i] = simulation::randomVector(random);
                    start.orientations[i] =
                        glm::normalize(start.orientations[i] + 0.3 * randomOrientation(random));
                    accelerations[i] = 20.0 * simulation::randomVector(random);
                    predicted[i] +=
                        substep * start.velocities[i] + substep * substep * accelerations[i];
                }
                StableCosseratParameters parameters{
                    .substep = substep,
                    .stretch_stiffness = modulus * simulation::kPi * 37e-6 * 37e-6};
                double before = 0.0;
                for (std::uint32_t i = 1; i <= 100; ++i) {
                    parameters.iterations = i;
                    RodState state = start;
                    stepStableCosserat(state, rest, accelerations, {}, parameters);
                    const double energy = objective(state, rest, predicted, parameters);
                    if (i > 1) {
                        EXPECT_LE(energy, before * (1.0 + 1e-12)) << i;
                    }
                    before = energy;
                }
            }
}

// The cantilever of the authors' code, examples/cantilever.cpp, as it was played with that code: 1
// m in ten segments of 1 kg/m, E I = G J = 4 N m^2, 100 N against stretch and shear, drag of 3/s,
// four iterations at 1/120 s. The figures have four digits.
TEST(ReferenceStableCosserat, DescendsAsTheAuthorsCode) {
    constexpr double kArea = simulation::kPi * 1e-4;  // m^2, of a radius of 1 cm
    const RodRest rest = makeRodRest(
        simulation::straightRod(10, 1.0), {.density = 1.0 / kArea,
                                           .radius = 0.01,
                                           .youngs_modulus = 4.0 / (kArea * 1e-4 / 4.0),
                                           .shear_modulus = 4.0 / (kArea * 1e-4 / 2.0)});
    RodState state = rodAtRest(rest);
    const StableCosseratParameters parameters{
        .method = CosseratMethod::descent,
        .substep = 1.0 / 120.0,
        .velocity_kept = 1.0 - 3.0 / 120.0,
        .stretch_stiffness = 100.0,
        .iterations = 4};
    const std::vector<glm::dvec3> accelerations(11, {0.0, -9.8, 0.0});
    int step = 0;
    for (const auto& [last, x, y] :
         {std::tuple{12, 0.9999, -0.0528}, {48, 0.9521, -0.3322}, {2400, 0.9657, -0.2846}}) {
        for (; step < last; ++step) stepStableCosserat(state, rest, accelerations, {}, parameters);
        const glm::dvec3 tip = state.positions().back();
        EXPECT_NEAR(tip.x, x, 1e-4) << last;
        EXPECT_NEAR(tip.y, y, 1e-4) << last;
    }
    double length = 0.0;
    for (const glm::dvec3& edge : state.edges) length += glm::length(edge);
    EXPECT_NEAR(length, 1.0103, 1e-4);
}

// A single segment under its weight has a mass of lambda l / 2 at its end. The clamp's torque 2 K
// sin(angle / 2), K = 2 E I / l, bears m g l cos(angle). The edge is l d3 plus m g l / k_ss down.
TEST(ReferenceStableCosserat, HoldsASingleSegmentUp) {
    for (const double length : {0.005, 0.02, 0.05}) {
        const RodMaterial material;
        const RodRest rest = makeRodRest(simulation::straightRod(1, length), material);
        const double weight = simulation::lineDensity(material) * length / 2.0 * simulation::kEarth;
        const double stiffness = 2.0 * simulation::bendingStiffness(material) / length;
        double low = 0.0, high = simulation::kPi / 2.0;
        for (int i = 0; i < 100; ++i) {
            const double angle = (low + high) / 2.0;
            (2.0 * stiffness * std::sin(angle / 2.0) < weight * length * std::cos(angle) ? low
                                                                                         : high) =
                angle;
        }
        const StableCosseratParameters parameters{
            .substep = 0.01, .velocity_kept = 0.5, .stretch_stiffness = 1e-4, .iterations = 1000};
        RodState state = rodAtRest(rest);
        const std::vector<glm::dvec3> accelerations(2, {0.0, -simulation::kEarth, 0.0});
        for (int i = 0; i < 300; ++i)
            stepStableCosserat(state, rest, accelerations, {}, parameters);
        const glm::dvec3 expected =
            length * glm::dvec3(std::cos(low), -std::sin(low), 0.0) -
            glm::dvec3(0.0, weight * length / parameters.stretch_stiffness, 0.0);
        EXPECT_LT(glm::distance(state.positions()[1], expected), 1e-9 * length) << length;
    }
}

// Each segment of a hair that hangs by its root has a strain of the weight below its middle over
// k_ss.
TEST(ReferenceStableCosserat, StretchesByTheWeightBelow) {
    constexpr int kSegments = 10;
    constexpr double kLength = 0.1, kStiffness = 1e-3;  // m, N
    const RodMaterial material;
    const RodRest rest =
        makeRodRest(simulation::straightRod(kSegments, kLength, {0.0, -1.0, 0.0}), material);
    RodState state = rodAtRest(rest);
    const StableCosseratParameters parameters{
        .substep = 0.01, .velocity_kept = 0.5, .stretch_stiffness = kStiffness};
    const std::vector<glm::dvec3> accelerations(kSegments + 1, {0.0, -simulation::kEarth, 0.0});
    for (int i = 0; i < 2000; ++i) stepStableCosserat(state, rest, accelerations, {}, parameters);
    const std::vector<glm::dvec3> positions = state.positions();
    for (std::size_t i = 1; i <= kSegments; ++i) {
        const double below = (kSegments - static_cast<double>(i) + 0.5) * kLength / kSegments;
        const double strain =
            simulation::lineDensity(material) * below * simulation::kEarth / kStiffness;
        EXPECT_NEAR(
            glm::distance(positions[i], positions[i - 1]) * kSegments / kLength, 1.0 + strain,
            1e-9);
    }
}

}  // namespace
}  // namespace hair::reference

namespace hair::simulation {
namespace {

using GpuStableCosserat = GpuTest;

// The stretch modulus is so great that shear adds only a thousandth to the bend at these lengths (4
// E I / (k_ss L^2)), and there are enough iterations. 24 segments err by a few thousandths.
TEST_F(GpuStableCosserat, HangsAsACantileverDoes) {
    for (const double gamma : {1.0, 10.0}) {
        SimulationSettings settings;
        settings.solver = Solver::stable_cosserat;
        settings.gravity = {0.0f, static_cast<float>(-kEarth), 0.0f};
        settings.friction = 0.1f;
        settings.stable_cosserat = {.iterations = 32, .stretch_modulus = 2e6f};
        settings.settle_steps = 300;
        const auto strand = straightRod(24, lengthFor(gamma, {}));
        const groom::Groom groom{
            .strand_count = 1,
            .vertices_per_strand = 25,
            .points = {strand.begin(), strand.end()},
            .root_normals = {},
            .root_triangles = {}};
        const Simulation simulation(device(), groom, settings, 1);
        const auto points = toDouble(simulation.readPositions());
        EXPECT_NEAR(dropOverReach(points) / benchmarks::physics::cantileverRatio(gamma), 1.0, 0.01)
            << gamma;
    }
}

}  // namespace
}  // namespace hair::simulation
