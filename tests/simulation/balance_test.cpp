#include <cmath>

#include <gtest/gtest.h>

#include "hair/simulation/simulation.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/simulation/gpu_simulation.h"
#include "tests/simulation/rods.h"
#include "tests/simulation/strands.h"

// Tests /simulation/rest "balanced" on the device.
namespace hair::simulation {
namespace {

// An arc that leaves the head sideways and hangs, a helix, an upright strand and a level one.
groom::Groom groomed() {
    constexpr int kSegments = 11;
    groom::Groom groom{.strand_count = 4, .vertices_per_strand = kSegments + 1};
    for (const auto& strand :
         {arc(kSegments, 0.15, 2.0), helix(kSegments, 0.01, 0.04, 1.5),
          straightRod(kSegments, 0.06, {0.0, 1.0, 0.0}), straightRod(kSegments, 0.05)})
        for (const glm::dvec3& point : strand)
            groom.points.emplace_back(point + glm::dvec3(0.1, 1.6, -0.05));
    return groom;
}

SimulationSettings balancedSettings(Solver solver) {
    SimulationSettings settings;
    settings.solver = solver;
    settings.rest = RestShape::balanced;
    settings.global.stiffness = 0.02f;
    settings.local.stiffness = 0.1f;
    return settings;
}

class BalancedRest : public GpuTest {
protected:
    // Returns the greatest distance of a vertex from its place in the groom after a second, over
    // the shortest guide's length.
    static double
    moved(const groom::Groom& groom, const SimulationSettings& settings, int steps = 60) {
        Simulation simulation(device(), groom, settings, 1);
        const std::vector<glm::vec3> start = simulation.readPositions();
        advance(device(), simulation, steps);
        return largestDifference(simulation.readPositions(), start) / 0.05;
    }
};

// The tolerance is 0.1 %: the error of a step is below 1e-5 of a guide, and springs reduce it.
TEST_F(BalancedRest, HairStaysAsItIsGroomed) {
    for (const Solver solver : {Solver::shape, Solver::rod}) {
        SimulationSettings settings = balancedSettings(solver);
        EXPECT_LT(moved(groomed(), settings), 0.001) << int(solver);
        settings.rest = RestShape::groom;
        EXPECT_GT(moved(groomed(), settings), 0.05) << "it would sag";
    }
}

// In substeps the local constraint damps less, and makes strongly curved hair like this flutter. So
// it is off here.
TEST_F(BalancedRest, HoldsInSubsteps) {
    for (const Solver solver : {Solver::shape, Solver::rod}) {
        SimulationSettings settings = balancedSettings(solver);
        settings.local.stiffness = 0.0f;
        settings.substeps = 3;
        EXPECT_LT(moved(groomed(), settings), 0.001) << int(solver);
    }
}

// In air with drag, the tensions of `shape` use a different metric from the pull toward the rest
// position. A curved guide then drifts by about 2 % of its length.
TEST_F(BalancedRest, HoldsInStillAirOfDrag) {
    for (const Solver solver : {Solver::shape, Solver::rod}) {
        SimulationSettings settings = balancedSettings(solver);
        settings.wind.mode = WindMode::drag;
        // moved() divides by 0.05 m: this is 3 % of 0.15 m.
        EXPECT_LT(moved(groomed(), settings), solver == Solver::rod ? 0.001 : 0.09);
    }
}

TEST_F(BalancedRest, HoldsWhateverKeepsLengthsAndHoweverItIsSpread) {
    for (const Parallelism parallelism :
         {Parallelism::vertex, Parallelism::strand, Parallelism::serial}) {
        SimulationSettings settings = balancedSettings(Solver::shape);
        settings.parallelism = parallelism;
        EXPECT_LT(moved(groomed(), settings), 0.001) << int(parallelism);
        settings.length = {.method = LengthMethod::iterate, .iterations = 5};
        EXPECT_LT(moved(groomed(), settings), 0.001) << int(parallelism);
    }
}

// The balance takes gravity in the frame of the head's first pose.
TEST_F(BalancedRest, HoldsOnATiltedHead) {
    for (const Solver solver : {Solver::shape, Solver::rod}) {
        SimulationSettings settings = balancedSettings(solver);
        settings.motion.keyframes = {
            {.time = 0.0f, .rotation = {20.0f, 10.0f, 70.0f}, .translation = {0.1f, 0.0f, 0.2f}}};
        EXPECT_LT(moved(groomed(), settings), 0.001) << int(solver);
    }
}

// Hair that starts within a body's margin, or even inside the body, is not pushed away. If
// something presses it against the body later, it is held where it started.
TEST_F(BalancedRest, BodiesKeepNoHairFartherAwayThanItStarts) {
    for (const Solver solver : {Solver::shape, Solver::rod}) {
        SimulationSettings settings = balancedSettings(solver);
        settings.collision.margin = 0.02f;
        // 1 mm below the level guide, which starts at (0.1, 1.6, -0.05).
        const glm::vec3 below{0.125f, 1.599f - 10.0f, -0.05f};
        settings.colliders = {{.a = below, .b = below, .radius = 10.0f}};
        groom::Groom level{.strand_count = 1, .vertices_per_strand = 12};
        const groom::Groom all = groomed();
        const auto points = all.strand(3);
        level.points.assign(points.begin(), points.end());
        EXPECT_LT(moved(level, settings), 0.001) << int(solver);
        settings.wind = {.strength = 300.0f, .direction = {0.0f, -1.0f, 0.0f}, .cone_angle = 0.0f};
        Simulation simulation(device(), level, settings, 1);
        advance(device(), simulation, 60);
        // Positions this far from the sphere's centre are rounded to 1e-6 m.
        Extremes gaps;
        for (const glm::vec3& point : simulation.readPositions())
            gaps.add(glm::distance(glm::dvec3(point), glm::dvec3(below)) - 10.0);
        EXPECT_GT(gaps.least(), 0.001 - 1e-5 - 4e-6) << int(solver);
        settings.colliders.clear();
        EXPECT_GT(moved(level, settings), 0.1) << "wind presses it down";
    }
}

TEST_F(BalancedRest, SaysWhatItDidAndWhatItCould) {
    const groom::Groom groom = groomed();
    EXPECT_EQ(Simulation(device(), groom, {}, 1).balance(), nullptr) << "nobody asked for it";
    SimulationSettings settings = balancedSettings(Solver::ftl);
    EXPECT_EQ(Simulation(device(), groom, settings, 1).balance(), nullptr)
        << "it has no rest shape";

    // Balance needs a certain stiffness, so a tenth of the modulus needs ten times the factor.
    // Factors have a precision of 5 %; the tolerance is twice that.
    settings = balancedSettings(Solver::rod);
    settings.material.youngs_modulus /= 4.0f;
    settings.material.shear_modulus /= 4.0f;
    const auto balanceOf = [&](const SimulationSettings& of) {
        return *Simulation(device(), groom, of, 1).balance();
    };
    const RestBalance limp = balanceOf(settings);
    EXPECT_TRUE(limp.unbalanced.empty());
    EXPECT_GT(limp.stiffened, 0u);
    settings.material.youngs_modulus /= 10.0f;
    settings.material.shear_modulus /= 10.0f;
    settings.most_stiffening = 1000.0f;
    const RestBalance limper = balanceOf(settings);
    EXPECT_EQ(limper.stiffened, 4u);
    EXPECT_NEAR(limper.stiffest / limp.stiffest, 10.0, 1.1);
    settings.most_stiffening = 1.0f;
    EXPECT_EQ(balanceOf(settings).unbalanced, (std::vector<std::uint32_t>{0, 1, 2, 3}));

    // Without a pull to the rest position nothing can hold the hair.
    settings = balancedSettings(Solver::shape);
    settings.global.stiffness = 0.0f;
    EXPECT_EQ(Simulation(device(), groom, settings, 1).balance()->unbalanced.size(), 4u);
}

// A reset restores the balanced state.
TEST_F(BalancedRest, IsThereAgainAfterAReset) {
    SimulationSettings settings = balancedSettings(Solver::shape);
    settings.wind.strength = 10.0f;
    Simulation simulation(device(), groomed(), settings, 1);
    const std::vector<glm::vec3> start = simulation.readPositions();
    advance(device(), simulation, 10);
    EXPECT_GT(largestDifference(simulation.readPositions(), start), 1e-3);
    simulation.reset();
    EXPECT_EQ(simulation.readPositions(), start);
    EXPECT_EQ(simulation.readPrevious(), start);
}

}  // namespace
}  // namespace hair::simulation
