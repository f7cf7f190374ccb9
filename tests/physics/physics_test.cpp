// The quick part of `hairbench physics`: the solvers' promises, on every build.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "benchmarks/physics/checks.h"
#include "benchmarks/physics/theory.h"
#include "hair/simulation/solvers.h"
#include "tests/error_text.h"
#include "tests/gpu_fixture.h"
#include "tests/temporary_folder.h"

namespace benchmarks::physics {
namespace {

using hair::Solver;

// Expects that every gate passes and that there is at least one.
void expectPass(const Findings& findings) {
    int gates = 0;
    for (const Outcome& each : findings.outcomes()) {
        EXPECT_NE(each.verdict, Verdict::skipped) << each.reason;
        if (each.tolerance) ++gates;
        std::string with;
        for (const Parameter& parameter : each.quantity.parameters)
            with += ' ' + parameter.name + ' ' + std::to_string(parameter.value);
        EXPECT_NE(each.verdict, Verdict::fail)
            << each.quantity.name << with << ": measured " << each.measured << ", expected "
            << each.expected.value_or(0.0) << ", tolerance " << each.tolerance.value_or(0.0) << ' '
            << each.reason;
    }
    EXPECT_GT(gates, 0);
}

using Physics = GpuTest;

// ---- Published results --------------------------------------------------------------------------

using Papers = GpuTest;

Findings played(
    const engine::Device& device, void (*play)(const engine::Device&, PaperSize, Findings&),
    Solver solver) {
    Findings findings("paper", solver);
    play(device, PaperSize::small, findings);
    return findings;
}

TEST_F(Papers, TheCantileverOfStableCosseratRods) {
    expectPass(played(device(), playStableCosserat, Solver::stable_cosserat));
}

TEST_F(Papers, IntegritySpringsHoldStrandsUp) {
    expectPass(played(device(), playAugmentedMassSpring, Solver::augmented_mass_spring));
}

TEST_F(Papers, FollowingTheLeaderKeepsLengths) {
    expectPass(played(device(), playFollowTheLeader, Solver::ftl));
}

TEST_F(Papers, MoreIterationsOfShapeConstraintsAreStiffer) {
    expectPass(played(device(), playShapeConstraints, Solver::shape));
}

TEST_F(Papers, APositionBasedRodBendsAndTwistsToAHelix) {
    expectPass(played(device(), playPositionBasedRod, Solver::position_based_rod));
}

class EverySolver : public GpuTest, public testing::WithParamInterface<hair::Named<hair::Solver>> {
protected:
    hair::Solver solver() const { return GetParam().value; }
};

INSTANTIATE_TEST_SUITE_P(, EverySolver, testing::ValuesIn(checkedSolvers()), [](const auto& each) {
    return std::string(each.param.name);
});

TEST_F(Physics, ShapeFliesLikeVerlet) {
    Findings findings("projectile", hair::Solver::shape);
    checkProjectile(device(), hair::Solver::shape, findings);
    expectPass(findings);
}

TEST_P(EverySolver, KeepsItsShapeInFreeFall) {
    Findings findings("free_fall", solver());
    checkFreeFall(device(), solver(), findings);
    expectPass(findings);
}

TEST_F(Physics, ShapeSwingsLikeADoublePendulum) {
    Findings findings("pendulum", hair::Solver::shape);
    checkPendulum(device(), hair::Solver::shape, std::array{2u}, findings);
    expectPass(findings);
}

TEST_F(Physics, ShapeHangsInACatenary) {
    Findings findings("catenary", hair::Solver::shape);
    checkCatenary(device(), hair::Solver::shape, findings);
    expectPass(findings);
}

TEST_F(Physics, RodHangsInACatenary) {
    Findings findings("catenary", hair::Solver::rod);
    checkCatenary(device(), hair::Solver::rod, findings);
    expectPass(findings);
}

TEST_F(Physics, RodMovesTheSameAtAnyTimeStep) {
    Findings findings("step_invariance", hair::Solver::rod);
    checkStepInvariance(device(), hair::Solver::rod, findings);
    expectPass(findings);
}

TEST_F(Physics, RodSagsLikeAnElastica) {
    Findings findings("cantilever", hair::Solver::rod);
    checkCantilever(device(), hair::Solver::rod, std::array{1.0, 10.0, 100.0}, findings);
    expectPass(findings);
}

TEST_F(Physics, RodSwingsAtTheFirstBendingFrequency) {
    Findings findings("bending_frequency", hair::Solver::rod);
    checkBendingFrequency(device(), hair::Solver::rod, findings);
    expectPass(findings);
}

TEST_F(Physics, RodWindsOutOfItsPlaneWhereKirchhoffsDoes) {
    Findings findings("bend_twist", hair::Solver::rod);
    checkBendTwist(device(), hair::Solver::rod, findings);
    expectPass(findings);
}

TEST_F(Physics, RodBucklesSidewaysWhereKirchhoffsDoes) {
    Findings findings("lateral_buckling", hair::Solver::rod);
    checkLateralBuckling(device(), hair::Solver::rod, findings);
    expectPass(findings);
}

TEST_F(Physics, RodSticksAndSlipsAsCoulombsCone) {
    Findings findings("stick_slip", hair::Solver::rod);
    checkStickSlip(device(), hair::Solver::rod, findings);
    expectPass(findings);
}

TEST_P(EverySolver, SlidesDownASlopeAsCoulombsLaw) {
    Findings findings("slide", solver());
    checkSlide(device(), solver(), findings);
    expectPass(findings);
}

TEST_F(Physics, RodLosesWhatItsMaterialsDampingSays) {
    Findings findings("bending_decay", hair::Solver::rod);
    checkBendingDecay(device(), hair::Solver::rod, findings);
    expectPass(findings);
}

TEST_F(Physics, RodTakesASetAsAStandardLinearSolidDoes) {
    Findings findings("bending_set", hair::Solver::rod);
    checkBendingSet(device(), hair::Solver::rod, findings);
    expectPass(findings);
}

TEST_F(Physics, RodRestsInWindLikeAnElastica) {
    Findings findings("drag_deflection", hair::Solver::rod);
    checkDragDeflection(device(), hair::Solver::rod, findings);
    expectPass(findings);
}

// The elastica of 7 cm is stable at both speeds, that of 15 cm flutters at 6 m/s.
TEST_F(Physics, RodRestsAndFluttersWhereTheElasticaDoes) {
    Findings findings("steady_drag", hair::Solver::rod);
    checkSteadyDrag(
        device(), hair::Solver::rod, std::array{2.5, 6.0}, std::array{0.07, 0.15}, findings);
    expectPass(findings);
    EXPECT_EQ(findings.outcomes().back().quantity.name, "swing of hair that flutters / length");
}

TEST_F(Physics, RodSagsWithItsCurlAsKirchhoffs) {
    Findings findings("curled_cantilever", hair::Solver::rod);
    checkCurledCantilever(device(), hair::Solver::rod, findings);
    expectPass(findings);
}

TEST_F(Physics, RodHangsFromATurningHeadAsKirchhoffs) {
    Findings findings("turning_head", hair::Solver::rod);
    checkTurningHead(device(), hair::Solver::rod, findings);
    expectPass(findings);
}

TEST_F(Physics, RodSwingsFarAsAChainOfLinks) {
    Findings findings("large_swing", hair::Solver::rod);
    checkLargeSwing(device(), hair::Solver::rod, findings);
    expectPass(findings);
}

// The least work: errors fall with the substep, and the cheapest solver of an error is named.
TEST_F(Physics, WorkAndPrecisionOfARod) {
    Findings findings("work_precision", hair::Solver::rod);
    checkWorkPrecision(device(), hair::Solver::rod, std::array{2u, 8u}, std::array{2u}, findings);
    ASSERT_EQ(findings.curves().size(), 2u);
    for (const Curve& curve : findings.curves()) {
        ASSERT_EQ(curve.rows.size(), 2u);
        EXPECT_GT(curve.rows[0][2], curve.rows[1][2]) << curve.name;
        EXPECT_GT(curve.rows[1][3], 0.0);
    }
}

TEST_P(EverySolver, IsBorneByAirAtTheTerminalSpeed) {
    Findings findings("terminal_speed", solver());
    checkTerminalSpeed(device(), solver(), findings);
    expectPass(findings);
}

TEST_F(Physics, AirDragsShapeAlongItself) {
    Findings findings("drag_along", hair::Solver::shape);
    checkDragAlong(device(), hair::Solver::shape, findings);
    expectPass(findings);
}

TEST_F(Physics, AirDragsRodsAlongThemselves) {
    Findings findings("drag_along", hair::Solver::rod);
    checkDragAlong(device(), hair::Solver::rod, findings);
    expectPass(findings);
}

TEST_F(Physics, HairHoldsHairUpToItsYieldStress) {
    Findings findings("hair_friction", hair::Solver::shape);
    checkHairFriction(device(), hair::Solver::shape, findings);
    expectPass(findings);
}

TEST_F(Physics, TwistedHairWindsToAHelix) {
    Findings findings("natural_twist", hair::Solver::rod);
    checkNaturalTwist(device(), hair::Solver::rod, findings);
    expectPass(findings);
}

TEST_F(Physics, ATwistedRodBearsTorque) {
    Findings findings("twist_torque", hair::Solver::rod);
    checkTwistTorque(device(), hair::Solver::rod, findings);
    expectPass(findings);
}

TEST_F(Physics, WetHairSagsAndJoins) {
    Findings findings("wet_hair", hair::Solver::rod);
    checkWetHair(device(), hair::Solver::rod, findings);
    expectPass(findings);
}

TEST_F(Physics, HairSheltersHairFromWind) {
    Findings findings("shelter", hair::Solver::shape);
    checkShelter(device(), hair::Solver::shape, findings);
    expectPass(findings);
}

TEST_P(EverySolver, LosesEnergyToFriction) {
    Findings findings("energy", solver());
    checkEnergy(device(), solver(), findings);
    expectPass(findings);
}

TEST_P(EverySolver, EndsInTheSameBitsTwice) {
    Findings findings("state_hash", solver());
    checkStateHash(device(), solver(), findings);
    expectPass(findings);
}

// ---- A solver from a file -----------------------------------------------------------------------

// Masses on springs: scenes/extended/mass_spring.glsl.
class MassSpring : public GpuTest {
protected:
    static const CheckedSolver& solver() {
        static const CheckedSolver solver(HAIRBENCH_SCENES_DIR "/extended/mass_spring.glsl");
        return solver;
    }

    // Springs along the strand alone, with this modulus in Pa.
    static hair::SimulationSettings springs(float modulus, float damping) {
        hair::SimulationSettings settings = freeHair(solver());
        for (hair::ExtensionValue& each : settings.solver_parameters.values) {
            if (each.name == "stretch_modulus") each.value.x = modulus;
            if (each.name == "bend_modulus" || each.name == "twist_modulus") each.value.x = 0.0f;
            if (each.name == "damping") each.value.x = damping;
        }
        return settings;
    }

    static double measured(const Findings& findings, std::string_view quantity) {
        for (const Outcome& each : findings.outcomes())
            if (each.quantity.name == quantity) return each.measured;
        return std::numeric_limits<double>::quiet_NaN();
    }
};

TEST_F(MassSpring, PassesTheChecksThatEverySolverPasses) {
    for (const char* const name : {"free_fall", "terminal_speed", "state_hash"}) {
        Findings findings(name, solver());
        std::ranges::find(allChecks(), std::string_view(name), &Check::name)
            ->run(device(), solver(), findings);
        expectPass(findings);
        EXPECT_EQ(findings.outcomes().front().solver, "mass_spring.glsl");
    }
}

// Other checks measure it and judge nothing.
TEST_F(MassSpring, PromisesNothingElse) {
    Findings findings("length", solver());
    checkLength(device(), solver(), findings);
    for (const Outcome& each : findings.outcomes()) EXPECT_EQ(each.verdict, Verdict::reported);
    EXPECT_LT(measured(findings, "greatest error of a segment's length"), 0.01);
}

// A segment of length l with n vertices below its upper end bears (n - 1/2) l of the hair's length,
// because the last vertex has half a segment. A spring of E S / l stretches under m g by m g l / (E
// S): the strain is rho g l (n - 1/2) / E. Positions are rounded by 2^-25 of 0.15 m at most: a
// strain of 4e-7, of at least 1.4e-3 here; friction leaves about as much.
TEST_F(MassSpring, HangsAsLongAsItsSpringsAreStretched) {
    constexpr std::uint32_t kSegments = 7;
    constexpr double kSegment = 0.15 / kSegments;
    constexpr float kModulus = 1e5f;
    hair::SimulationSettings settings = springs(kModulus, 0.0f);
    settings.friction = 0.3f;
    Experiment experiment(device(), straightStrand(kSegments, 0.15, {0.0, -1.0, 0.0}), settings);
    ASSERT_TRUE(experiment.settle(1e-8, 10.0));
    const std::vector<glm::dvec3> points = experiment.positions();
    for (std::uint32_t i = 1; i <= kSegments; ++i) {
        const double strain = glm::distance(points[i], points[i - 1]) / kSegment - 1.0;
        const double expected = double{settings.material.density} * kGravity * kSegment *
                                (kSegments - i + 0.5) / kModulus;
        EXPECT_NEAR(strain, expected, 1e-3 * expected + 2e-6) << i;
    }
}

// One mass on a spring. Its period is that of the stretched length, and a bob on a stiff spring
// swings slower by the strain's order squared. An explicit step of h shortens the period by (w h)^2
// / 24, 1e-6; the crossings' times are as exact as those of the check `pendulum`.
TEST_F(MassSpring, SwingsLikeAPendulum) {
    constexpr double kLength = 0.1;  // m
    const hair::SimulationSettings settings = springs(1e6f, 0.0f);
    Experiment experiment(device(), straightStrand(1, kLength, {0.0, -1.0, 0.0}), settings);
    const double stretched =
        kLength * (1.0 + double{settings.material.density} * kGravity * kLength / 2.0 / 1e6);
    const double expected = std::sqrt(kGravity / stretched) / (2.0 * kPi);
    const auto frequency = measureFrequency(
        experiment, {.shape = std::array{0.0, 1.0},
                     .segment = kLength,
                     .direction = {0.0, -1.0, 0.0},
                     .sideways = {1.0, 0.0, 0.0},
                     .expected_frequency = expected});
    ASSERT_TRUE(frequency);
    EXPECT_NEAR(*frequency / expected, 1.0, 0.002);
}

// A bob that falls from the horizontal, without friction and damping: kinetic energy, the weight's
// and the spring's, over m g L. An explicit step conserves a nearby energy, off by w h / 2 of the
// elastic part: w = sqrt(k / m) = 390/s, h = 1/2040 s, and the spring's energy is below (3 m g)^2 /
// 2 k, 0.003 of m g L.
TEST_F(MassSpring, KeepsItsEnergy) {
    constexpr double kLength = 0.1;  // m
    hair::SimulationSettings settings = springs(1e6f, 0.0f);
    settings.time_step = hair::simulation::stepOf(settings).sub;
    settings.substeps = 1;
    Experiment experiment(device(), straightStrand(1, kLength, {1.0, 0.0, 0.0}), settings);
    // Divided by the mass, rho S L / 2: the spring's stiffness is E S / L.
    const double stiffness = 2.0 * 1e6 / (double{settings.material.density} * kLength * kLength);
    glm::dvec3 before = experiment.positions()[1];
    double farthest = 0.0, lowest = 0.0;
    for (std::uint32_t i = 0; i < experiment.stepsIn(3.0); ++i) {
        experiment.advance(1);
        const glm::dvec3 after = experiment.positions()[1];
        const glm::dvec3 middle = 0.5 * (before + after);
        const glm::dvec3 velocity = (after - before) / experiment.substep();
        const double stretch = glm::length(middle) - kLength;
        const double energy = 0.5 * glm::dot(velocity, velocity) + kGravity * middle.y +
                              0.5 * stiffness * stretch * stretch;
        farthest = worst(farthest, std::abs(energy) / (kGravity * kLength));
        lowest = std::min(lowest, middle.y);
        before = after;
    }
    EXPECT_LT(farthest, 0.003);
    EXPECT_LT(lowest, -0.99 * kLength);
}

// The file limits substeps to 0.5 ms, so that all steps have similar ones, in which its springs are
// not softened. The tolerance is the one that rods promise.
TEST_F(MassSpring, MovesTheSameAtAnyTimeStep) {
    hair::SimulationSettings settings = defaultHair(solver());
    const Trajectory coarse = playRelease(device(), settings, 8);
    settings.time_step = 1.0f / 480.0f;
    EXPECT_LT(differenceOf(playRelease(device(), settings, 8), coarse), 0.02);
}

// Finer segments than a step can bear become softer, and no vertex leaves.
TEST_F(MassSpring, IsStableWithStiffSpringsAndShortSegments) {
    hair::SimulationSettings settings = springs(1e9f, 1e-3f);
    settings.friction = 0.05f;
    Experiment experiment(device(), straightStrand(63, 0.15, {1.0, 0.0, 0.0}), settings);
    experiment.advance(experiment.stepsIn(2.0));
    for (const glm::dvec3& point : experiment.positions()) EXPECT_LT(glm::length(point), 0.3);
}

TEST(CheckedSolvers, AreFilesToo) {
    const std::string file = HAIRBENCH_SCENES_DIR "/extended/mass_spring.glsl";
    const std::vector<CheckedSolver> chosen = chosenSolvers({"rod", file});
    ASSERT_EQ(chosen.size(), 2u);
    EXPECT_EQ(nameOf(chosen[0]), "rod");
    EXPECT_EQ(nameOf(chosen[1]), "mass_spring.glsl");
    EXPECT_FALSE(lack(chosen[1], Need::bending));
    EXPECT_TRUE(lack(chosen[1], Need::iterations));
    EXPECT_EQ(chosenSolvers({}).size(), checkedSolvers().size());
    const TemporaryFolder folder;
    const std::string wrong = folder.write("wrong.glsl", "void solve(Guide guide) {}\n").string();
    EXPECT_EQ(
        errorText([&] { chosenSolvers({wrong}); }),
        "--solver " + wrong + ": /simulation/solver: " + wrong +
            ": has no function void solveGuide(Guide guide)");
}

}  // namespace
}  // namespace benchmarks::physics
