// The quick part of `hairbench physics`: the solvers' promises, on every build.
#include <algorithm>

#include "benchmarks/physics/checks.h"
#include "tests/gpu_fixture.h"

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

TEST_F(Physics, RodRestsInWindLikeAnElastica) {
    Findings findings("drag_deflection", hair::Solver::rod);
    checkDragDeflection(device(), hair::Solver::rod, findings);
    expectPass(findings);
}

TEST_P(EverySolver, IsBorneByAirAtTheTerminalSpeed) {
    Findings findings("terminal_speed", solver());
    checkTerminalSpeed(device(), solver(), findings);
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

}  // namespace
}  // namespace benchmarks::physics
