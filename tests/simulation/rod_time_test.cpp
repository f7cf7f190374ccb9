#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "benchmarks/physics/theory.h"
#include "hair/reference/rod.h"
#include "hair/reference/solvers.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/simulation/gpu_simulation.h"
#include "tests/simulation/rods.h"
#include "tests/simulation/strands.h"

// Tests the time integration of `rod`: material damping, set, and implicit Euler beside generalised
// alpha. The reference in double precision is compared with theory, and the device with the
// reference.
namespace hair::simulation {
namespace {

using reference::Integrator;
using reference::makeRodRest;
using reference::RodMaterial;
using reference::RodRest;
using reference::RodScheme;
using reference::RodState;

constexpr double kDefaultSubstep = 1.0 / 480.0;  // s

// Returns the frequency of a clamped hair's first bending mode, rad/s.
double firstMode(double length) {
    const RodMaterial material;
    return 2.0 * kPi *
           benchmarks::physics::cantileverFrequency(
               bendingStiffness(material), lineDensity(material), length);
}

// Returns the half-life of a free oscillation from its samples, s, by a least-squares fit of y[k +
// 1] = s y[k] - d y[k - 1] with d = exp(-2 rate interval).
double halfLifeOf(const std::vector<double>& samples, double interval) {
    double yy = 0.0, yz = 0.0, zz = 0.0, yx = 0.0, zx = 0.0;
    for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
        const double y = samples[i], z = -samples[i - 1], x = samples[i + 1];
        yy += y * y;
        yz += y * z;
        zz += z * z;
        yx += y * x;
        zx += z * x;
    }
    const double d = (yy * zx - yz * yx) / (yy * zz - yz * yz);
    return std::log(2.0) / (-std::log(d) / (2.0 * interval));
}

// Kelvin-Voigt damping: a mode of frequency w decays at the rate w^2 tau / 2. The tolerance is 3 %.
// The ratio of a step is off by at most w^2 h tau / 4, 0.8 % here; 32 segments swing 0.1 % too
// slowly; and viscosity acts by the torque in the middle of a step, which is off by w h.
TEST(ReferenceRodTime, LosesWhatItsMaterialsDampingSays) {
    constexpr int kSegments = 16;
    constexpr double kLength = 0.1;
    const double w = firstMode(kLength);
    const RodRest rest = makeRodRest(straightRod(kSegments, kLength), {});
    const std::vector<glm::dvec3> none(kSegments + 1, glm::dvec3(0.0));
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::generalized_alpha})
        for (const double half_life : {0.25, 2.0})
            for (const double substep : {kDefaultSubstep, kDefaultSubstep / 2.0}) {
                RodState state = rodAtRest(rest);
                for (int i = 1; i <= kSegments; ++i)
                    state.velocities[static_cast<std::size_t>(i)].y =
                        0.02 *
                        benchmarks::physics::cantileverShape(static_cast<double>(i) / kSegments);
                const int every = static_cast<int>(std::lround(0.5 * kPi / w / substep));
                std::vector<double> samples;
                for (int i = 0; i < 8 * every; ++i) {
                    stepRod(
                        state, rest, none, {}, substep, 1.0,
                        {.integrator = integrator,
                         .damping = 2.0 * std::log(2.0) / (w * w * half_life)});
                    if (i % every == 0) samples.push_back(state.positions().back().y);
                }
                EXPECT_NEAR(halfLifeOf(samples, every * substep) / half_life, 1.0, 0.03)
                    << static_cast<int>(integrator) << " " << half_life << " " << substep;
            }
}

std::vector<glm::dvec3> swung(double substep, Integrator integrator) {
    const RodRest rest = makeRodRest(straightRod(8, 0.15, {0.1, -std::sqrt(0.99), 0.0}), {});
    RodState state = rodAtRest(rest);
    const std::vector<glm::dvec3> accelerations(9, {0.0, -kEarth, 0.0});
    for (int i = 0; i < std::lround(0.5 / substep); ++i)
        stepRod(
            state, rest, accelerations, {}, substep, 1.0,
            {.iterations = 6, .integrator = integrator});
    return state.positions();
}

// Half the step makes a quarter of the error, and with implicit Euler half of it. The test demands
// a factor of 3: below the order's 4, to allow for third order, and above implicit Euler's 2.
TEST(ReferenceRodTime, IsOfTheOrderThatItsIntegratorHas) {
    const auto exact = swung(1.0 / 7680.0, Integrator::generalized_alpha);
    const auto gain = [&](Integrator integrator) {
        return largestDifference(swung(1.0 / 240.0, integrator), exact) /
               largestDifference(swung(1.0 / 480.0, integrator), exact);
    };
    EXPECT_GT(gain(Integrator::generalized_alpha), 3.0);
    EXPECT_LT(gain(Integrator::implicit_euler), 2.2);
}

double energyOf(const RodState& state, const RodRest& rest) {
    double energy = rodEnergy(state, rest);
    const std::vector<glm::dvec3> positions = state.positions();
    for (std::size_t i = 1; i < positions.size(); ++i)
        energy += rest.masses[i] * kEarth * positions[i].y;
    return energy;
}

// Hair with a kink is held at both ends, or released hanging or upright, from stiff to limp.
// Methods of second order blow up here if Newton's method does not converge. Without damping the
// energy never exceeds its first value; the tolerance for rounding is a thousandth of the weight's
// energy.
TEST(ReferenceRodTime, GainsNoEnergyWhereItWhips) {
    constexpr int kSegments = 32;
    constexpr double kLength = 0.2;
    const double usual = RodMaterial{}.density * kEarth * std::pow(kLength, 3.0) * kPi *
                         std::pow(RodMaterial{}.radius, 2.0) / bendingStiffness({});
    enum class Way { held, hanging, standing };
    for (const double gamma : {10.0, 1e3, 1e6})
        for (const Way way : {Way::held, Way::hanging, Way::standing}) {
            RodMaterial material;
            material.youngs_modulus *= usual / gamma;
            material.shear_modulus *= usual / gamma;
            const RodRest rest =
                makeRodRest(straightRod(kSegments, kLength, {0.0, -1.0, 0.0}), material);
            std::vector<glm::dvec3> start = vee(kSegments, kLength, 0.1);
            if (way == Way::standing)
                for (glm::dvec3& point : start) point.y = -point.y;
            RodState state = rodFrom(rest, start, start, kDefaultSubstep);
            if (way == Way::held) state.pins[kSegments] = start[kSegments];
            const double first = energyOf(state, rest);
            const double weight = lineDensity(material) * kLength * kEarth * kLength;
            const std::vector<glm::dvec3> accelerations(kSegments + 1, {0.0, -kEarth, 0.0});
            double greatest = -std::numeric_limits<double>::infinity();
            for (int i = 0; i < 960; ++i) {
                stepRod(
                    state, rest, accelerations, {}, kDefaultSubstep, 1.0,
                    {.integrator = Integrator::generalized_alpha});
                const double energy = energyOf(state, rest);
                ASSERT_TRUE(std::isfinite(energy));
                greatest = std::max(greatest, energy);
            }
            EXPECT_LT(greatest, first + 1e-3 * weight) << gamma << " " << static_cast<int>(way);
        }
}

// ---- Set ----------------------------------------------------------------------------------------

// A straight rod whose segments are turned further and further by this rotation.
RodState wound(const RodRest& rest, double angle, const glm::dvec3& axis) {
    RodState state = rodAtRest(rest);
    for (std::size_t i = 1; i < rest.lengths.size(); ++i) {
        state.orientations[i] = state.orientations[i - 1] * glm::angleAxis(angle, axis);
        state.edges[i] = rest.lengths[i] * (state.orientations[i] * glm::dvec3(0.0, 0.0, 1.0));
    }
    return state;
}

// The rod is held as wound for this time, without forces.
RodState held(
    const RodRest& rest, const RodState& state, const RodScheme& scheme, double substep,
    int steps) {
    const std::vector<glm::dvec3> none(rest.lengths.size(), glm::dvec3(0.0));
    RodState now = state;
    for (int i = 0; i < steps; ++i) {
        stepRod(now, rest, none, {}, substep, 0.0, scheme);
        std::vector<glm::dquat> set = now.set;
        now = state;
        now.set = std::move(set);
    }
    return now;
}

const glm::dvec3 kBends(1.0, 0.0, 0.0), kTwists(0.0, 0.0, 1.0);
constexpr double kWinding = 0.05;  // rad per joint
constexpr double kSetTime = 0.5;  // s

// The energy of a held bend or twist falls from K b^2 / 2 to ((1 - s) + s exp(-2 t / tau)) of that,
// as the moment falls to (1 - s) + s exp(-t / tau). Here t counts from the middle of the substep in
// which the strain grew. The mean of exp(-t / tau) over a substep is (h / tau)^2 / 24 above that of
// its middle, and a discrete joint's energy b^2 / 24 above K b^2 / 2: 2e-4 both.
TEST(ReferenceRodTime, HeldMomentsRelaxAsThoseOfAStandardLinearSolid) {
    const RodRest rest = makeRodRest(straightRod(16, 0.03), {});
    for (const glm::dvec3& axis : {kBends, kTwists})
        for (const double share : {0.3, 0.8})
            for (const double substep : {1.0 / 60.0, 1.0 / 240.0})
                for (const double time : {0.1, 0.5, 2.0}) {
                    const RodState state = wound(rest, kWinding, axis);
                    const int steps = static_cast<int>(std::lround(time / substep));
                    const RodScheme scheme{.set_share = share, .set_time = kSetTime};
                    const double energy =
                        rodEnergy(held(rest, state, scheme, substep, steps), rest, scheme, substep);
                    const double strain = std::exp(-(steps + 0.5) * substep / kSetTime);
                    EXPECT_NEAR(
                        energy / rodEnergy(state, rest), 1.0 - share + share * strain * strain,
                        5e-4)
                        << axis.z << ' ' << share << ' ' << substep << ' ' << time;
                }
}

// Released at once, hair keeps s (1 - exp(-T / tau)) of the bend or twist that it was held at for
// T, and exp(-(1 - s) t / tau) of this after t. The first step of the release holds hair for a step
// more, and lets it go in its middle. Steps are of second order, (h / tau)^2 / 12 of a rate: 3e-4
// after 2.8 times of the set's own time. Hair of 5 mm reaches equilibrium within 1/300 in a step
// that carries no velocity, and lags by as much of a step.
TEST(ReferenceRodTime, SetGoesInItsOwnTime) {
    constexpr double kHold = 0.5;  // s
    const RodRest rest = makeRodRest(straightRod(16, 0.005), {});
    const std::vector<glm::dvec3> none(17, glm::dvec3(0.0));
    for (const glm::dvec3& axis : {kBends, kTwists})
        for (const double share : {0.3, 0.8})
            for (const double substep : {1.0 / 60.0, 1.0 / 240.0}) {
                const RodScheme scheme{.iterations = 4, .set_share = share, .set_time = kSetTime};
                RodState state = held(
                    rest, wound(rest, kWinding, axis), scheme, substep,
                    static_cast<int>(std::lround(kHold / substep)));
                const int whole = static_cast<int>(std::lround(1.0 / substep));
                for (int i = 1; i <= 2 * whole; ++i) {
                    stepRod(state, rest, none, {}, substep, 0.0, scheme);
                    if (i % (whole / 4) != 0) continue;
                    double left = 0.0;
                    for (std::size_t joint = 1; joint <= 16; ++joint) {
                        const glm::dquat strain = glm::conjugate(state.orientations[joint - 1]) *
                                                  state.orientations[joint];
                        left += 2.0 * glm::dot(glm::dvec3(strain.x, strain.y, strain.z), axis) /
                                kWinding / 16.0;
                    }
                    const double expected =
                        share * -std::expm1(-(kHold + substep) / kSetTime) *
                        std::exp(-(1.0 - share) * (i - 0.5) * substep / kSetTime);
                    EXPECT_NEAR(left / expected, 1.0, 1e-3)
                        << axis.z << ' ' << share << ' ' << substep << ' ' << i;
                }
            }
}

// Nothing acts on a curl that lets go of a strong bend but its own joints. Few Newton steps leave
// 1e-6 of the energy, as in ReferenceRod.NeverGainsEnergy.
TEST(ReferenceRodTime, SetOnlyTakesEnergy) {
    const RodRest rest = makeRodRest(helix(32, 0.01, 0.03, 3.0), {});
    const std::vector<glm::dvec3> none(33, glm::dvec3(0.0));
    for (const double share : {0.3, 0.95})
        for (const double time : {0.002, 0.05, 1.0})
            for (const double angle : {0.3, 1.0}) {
                const RodScheme scheme{.iterations = 8, .set_share = share, .set_time = time};
                RodState state = rodAtRest(rest);
                for (std::size_t i = 1; i < 33; ++i) {
                    state.orientations[i] =
                        state.orientations[i] *
                        glm::angleAxis(
                            angle * std::sin(double(i)), glm::normalize(glm::dvec3(1, 2, 1)));
                    state.edges[i] =
                        rest.lengths[i] * (state.orientations[i] * glm::dvec3(0.0, 0.0, 1.0));
                }
                double before = std::numeric_limits<double>::infinity();
                double first = 0.0;
                for (int i = 0; i < 500; ++i) {
                    stepRod(state, rest, none, {}, kDefaultSubstep, 1.0, scheme);
                    const double now = rodEnergy(state, rest, scheme, kDefaultSubstep);
                    if (i == 0) first = now;
                    ASSERT_LE(now, before + 1e-6 * first) << share << ' ' << time << ' ' << i;
                    before = now;
                }
                EXPECT_LT(before, 0.5 * first);
            }
}

// ---- On the device ------------------------------------------------------------------------------

using GpuRodTime = GpuTest;

SimulationSettings settingsOf(RodIntegrator integrator, float damping, float set_share = 0.0f) {
    SimulationSettings settings;
    settings.solver = Solver::rod;
    settings.friction = 0.0f;
    settings.rod.integrator = integrator;
    settings.material.damping = damping;
    settings.material.set_share = set_share;
    settings.material.set_time = 0.1f;
    return settings;
}

// 200 substeps with the rounding of EveryGpuRod.TakesTheReferencesSteps. A strand whose turn is as
// near to kSmoothTurn as rounding may take another kind of step than the reference. Wavy hair on a
// head at rest has no such strand.
TEST_F(GpuRodTime, TakesTheReferencesSteps) {
    for (const RodIntegrator integrator :
         {RodIntegrator::implicit_euler, RodIntegrator::generalized_alpha})
        for (const float damping : {0.0f, 0.01f})
            for (const float set_share : {0.0f, 0.7f}) {
                const groom::Groom groom = wavyGroom(10, 17, 0.2 / 16.0);
                const SimulationSettings settings = settingsOf(integrator, damping, set_share);
                Simulation simulation(device(), groom, settings, 1);
                reference::Reference reference(groom, settings, 1);
                advance(device(), simulation, 25);
                for (int i = 0; i < 25; ++i) reference.step();
                EXPECT_LT(
                    largestDifference(simulation.readPositions(), reference.positions()) /
                        longestStrand(groom),
                    4e-5)
                    << static_cast<int>(integrator) << " " << damping << " " << set_share;
            }
}

// Half a second of hair that takes a set on a head that turns, in wind and among bodies, with the
// rounding of EveryGpuRod.FollowsTheHeadAndKeepsOutOfBodiesAsTheReferenceDoes.
TEST_F(GpuRodTime, TakesASetOnAMovingHeadAsTheReferenceDoes) {
    for (const float ellipticity : {1.0f, 1.8f}) {
        SimulationSettings settings = settingsOf(RodIntegrator::implicit_euler, 0.0f, 0.7f);
        settings.material.ellipticity = ellipticity;
        settings.substeps = 4;
        settings.friction = 0.02f;
        settings.wind.strength = 10.0f;
        settings.motion.keyframes = {
            {.time = 0.0f},
            {.time = 0.25f, .rotation = {10.0f, 40.0f, -5.0f}, .translation = {0.0f, 0.05f, 0.1f}},
            {.time = 0.5f, .rotation = {0.0f, -30.0f, 0.0f}, .translation = {0.1f, 0.0f, 0.0f}}};
        settings.colliders = {
            {.a = {0.1f, -0.1f, 0.03f}, .b = {0.3f, -0.1f, 0.03f}, .radius = 0.03f}};
        settings.collision = {.margin = 0.001f, .friction = 0.2f};
        const groom::Groom groom = straightGroom(8, 17, 0.015);
        Simulation simulation(device(), groom, settings, 1);
        reference::Reference reference(groom, settings, 1);
        advance(device(), simulation, 30);
        for (int i = 0; i < 30; ++i) reference.step();
        EXPECT_LT(
            largestDifference(simulation.readPositions(), reference.positions()) /
                longestStrand(groom),
            1e-4)
            << ellipticity;
        settings.material.set_share = 0.0f;
        Simulation elastic(device(), groom, settings, 1);
        advance(device(), elastic, 30);
        EXPECT_GT(
            largestDifference(elastic.readPositions(), reference.positions()) /
                longestStrand(groom),
            0.01)
            << ellipticity;
    }
}

// A set is one of the material: it turns with the hair. A curl turns with its head by three
// quarters of a turn a second, without weight, so slowly that it keeps its shape; a set in axes of
// space would pull it off by its own size.
TEST_F(GpuRodTime, TurningTakesNoSet) {
    const std::vector<glm::dvec3> curl = helix(24, 0.004, 0.003, 2.0);
    groom::Groom groom{.strand_count = 1, .vertices_per_strand = 25};
    groom.points.assign(curl.begin(), curl.end());
    SimulationSettings settings = settingsOf(RodIntegrator::implicit_euler, 0.0f, 0.9f);
    settings.gravity = {};
    settings.friction = 0.02f;
    settings.motion.keyframes = {
        {}, {.time = 2.0f, .rotation = {60.0f, 540.0f, 0.0f}, .translation = {}}};
    Simulation simulation(device(), groom, settings, 1);
    advance(device(), simulation, 120);
    const RigidMotion head = simulation.pose();
    std::vector<glm::dvec3> carried;
    for (const glm::vec3& point : groom.points) carried.push_back(head(point));
    EXPECT_LT(largestDifference(simulation.readPositions(), carried) / 0.004, 0.02);
}

// The share that yields bears none of the weight in the groom's shape, so hair hangs there for
// good: a balanced rod moves by the rounding of its segments' directions, 1e-7 rad each, which its
// weight answers with up to ten times that.
TEST_F(GpuRodTime, BalancedHairTakesNoSetFromItsWeight) {
    const groom::Groom groom = wavyGroom(10, 17, 0.1 / 16.0);
    SimulationSettings settings = settingsOf(RodIntegrator::implicit_euler, 0.0f, 0.6f);
    settings.rest = RestShape::balanced;
    Simulation simulation(device(), groom, settings, 1);
    ASSERT_NE(simulation.balance(), nullptr);
    EXPECT_TRUE(simulation.balance()->unbalanced.empty());
    advance(device(), simulation, 120);  // 20 times the time of the set
    EXPECT_LT(
        largestDifference(
            simulation.readPositions(),
            std::vector<glm::dvec3>(groom.points.begin(), groom.points.end())) /
            longestStrand(groom),
        1e-4);
}

// A reset also restores the state that the integrator keeps between substeps, and the set.
TEST_F(GpuRodTime, RepeatsItselfToTheBit) {
    const groom::Groom groom = wavyGroom(20, 9, 0.01);
    SimulationSettings settings = settingsOf(RodIntegrator::generalized_alpha, 0.001f, 0.5f);
    settings.settle_steps = 5;
    settings.wind.strength = 10.0f;
    Simulation simulation(device(), groom, settings, 1);
    advance(device(), simulation, 10);
    const auto points = simulation.readPositions();
    simulation.reset();
    advance(device(), simulation, 10);
    EXPECT_EQ(points, simulation.readPositions());
}

// Limp hair that is thrown about among bodies stays finite and whole. Segments that are not pushed
// keep their length to a thousandth. So no vertex is farther from its root than the strand's
// length, except for the stretch by bodies.
TEST_F(GpuRodTime, EnduresBodiesAndViolence) {
    const groom::Groom groom = wavyGroom(9, 17, 0.01);
    for (const float modulus : {1.0f, 3.9e9f, 1e12f})
        for (const float damping : {0.0f, 1.0f}) {
            SimulationSettings settings = settingsOf(
                RodIntegrator::generalized_alpha, damping, damping > 0.0f ? 0.95f : 0.0f);
            settings.material.set_time = 0.001f;
            settings.material.youngs_modulus = modulus;
            settings.material.shear_modulus = modulus;
            settings.colliders = {{.radius = 0.05f}};
            settings.motion.keyframes = {
                {},
                {.time = 0.2f, .rotation = {0, 300, 0}, .translation = {0.3f, 0, 0}},
                {.time = 0.4f}};
            Simulation simulation(device(), groom, settings, 1);
            advance(device(), simulation, 60);
            const auto points = simulation.readPositions();
            for (std::size_t i = 0; i < points.size(); ++i) {
                const glm::vec3 root = points[i - i % groom.vertices_per_strand];
                ASSERT_LT(double{glm::distance(points[i], root)}, 1.1 * longestStrand(groom))
                    << modulus << " " << damping;
            }
        }
}

}  // namespace
}  // namespace hair::simulation
