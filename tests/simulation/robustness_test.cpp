#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "hair/reference/solvers.h"
#include "hair/simulation/solvers.h"
#include "tests/gpu_fixture.h"
#include "tests/simulation/gpu_simulation.h"
#include "tests/simulation/parallelisms.h"
#include "tests/simulation/strands.h"

// Positions are never NaN or infinite, on the device and in the reference, with any groom and any
// parameters.
namespace hair::simulation {
namespace {

bool finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Returns strands with every kind of bad segment: no length at the root, in the middle and at the
// tip; all vertices in one point; folded back; almost no length.
groom::Groom badGroom() {
    groom::Groom groom{.strand_count = 6, .vertices_per_strand = 5};
    groom.points = {
        {0, 0, 0},    {0, 0, 0},       {0, -0.02f, 0},  {0, -0.04f, 0},   {0, -0.06f, 0},
        {0.1f, 0, 0}, {0.1f, 0.1f, 0}, {0.1f, 0.1f, 0}, {0.2f, 0.1f, 0},  {0.2f, 0.1f, 0},
        {0.5f, 1, 1}, {0.5f, 1, 1},    {0.5f, 1, 1},    {0.5f, 1, 1},     {0.5f, 1, 1},
        {0, 0, 1},    {0, 0.1f, 1},    {0, 0, 1},       {0, 0.1f, 1},     {0, 0, 1},
        {0, 0, 0},    {1e-12f, 0, 0},  {2e-12f, 0, 0},  {3e-12f, 0, 0},   {4e-12f, 0, 0},
        {0, 0, 2},    {0, -1e-4f, 2},  {0, -0.5f, 2},   {0, -0.5001f, 2}, {0, -2, 2}};
    return groom;
}

std::vector<SimulationSettings> extremes() {
    std::vector<SimulationSettings> all;
    for (const auto& [solver, scaling] :
         {std::pair{Solver::shape, StiffnessScaling::thesis},
          std::pair{Solver::shape, StiffnessScaling::invariant},
          std::pair{Solver::ftl, StiffnessScaling::invariant},
          std::pair{Solver::rod, StiffnessScaling::invariant},
          std::pair{Solver::stable_cosserat, StiffnessScaling::invariant},
          std::pair{Solver::position_based_rod, StiffnessScaling::invariant},
          std::pair{Solver::augmented_mass_spring, StiffnessScaling::invariant}})
        for (const float stiffness : {0.0f, 1.0f})
            for (const float step : {0.0005f, 0.1f})
                for (const float wind : {0.0f, 1500.0f}) {
                    SimulationSettings settings;
                    settings.solver = solver;
                    settings.ftl.velocity_correction = stiffness;
                    settings.stiffness_scaling = scaling;
                    settings.time_step = step;
                    settings.global.stiffness = stiffness;
                    settings.local.stiffness = stiffness;
                    settings.friction = stiffness;
                    settings.wind.strength = wind;
                    settings.wind.gust_rate = 100.0f;
                    settings.collision = {.margin = 0.01f, .friction = 0.5f};
                    settings.colliders = {{.radius = 0.05f}, {.a = {1, 1, 1}, .b = {-1, 1, 1}}};
                    all.push_back(settings);
                }
    return all;
}

// Steps in which a solver takes 200 of its own: what grows in each of them has overflowed by then.
// At least 10 whole steps, so that wind and bodies act several times.
int enoughSteps(const SimulationSettings& settings) {
    return std::max(10, 200 / static_cast<int>(stepOf(settings).count));
}

TEST(ReferenceRobustness, StaysFinite) {
    const groom::Groom groom = badGroom();
    for (const SimulationSettings& settings : extremes()) {
        reference::Reference solver(groom, settings, 1);
        for (int i = 0; i < enoughSteps(settings); ++i) solver.step();
        for (const glm::dvec3& point : solver.positions()) ASSERT_TRUE(finite(point));
    }
}

class GpuRobustness : public GpuTest, public testing::WithParamInterface<Parallelism> {};

FOR_EVERY_PARALLELISM(GpuRobustness);

TEST_P(GpuRobustness, StaysFinite) {
    const groom::Groom groom = badGroom();
    const std::vector<glm::vec3> collapsed(groom.points.size(), glm::vec3(0.0f));
    for (SimulationSettings settings : extremes()) {
        if (settings.solver != Solver::shape && GetParam() != Parallelism::serial) continue;
        settings.parallelism = GetParam();
        Simulation simulation(device(), groom, settings, 1);
        advance(device(), simulation, enoughSteps(settings));
        for (const glm::vec3& point : simulation.readPositions()) ASSERT_TRUE(finite(point));
        simulation.setState(collapsed, collapsed);
        advance(device(), simulation, enoughSteps(settings));
        for (const glm::vec3& point : simulation.readPositions()) ASSERT_TRUE(finite(point));
    }
}

// Device and reference have the same conventions for segments without a direction.
TEST_P(GpuRobustness, TakesBadSegmentsLikeTheReference) {
    const groom::Groom groom = badGroom();
    for (const float wind : {0.0f, 15.0f}) {
        SimulationSettings settings;
        settings.parallelism = GetParam();
        settings.local.stiffness = 0.5f;
        settings.wind.strength = wind;
        Simulation simulation(device(), groom, settings, 1);
        reference::Reference solver(groom, settings, 1);
        advance(device(), simulation, 1);
        solver.step();
        // Directions of segments as short as rounding are arbitrary: 1e-6 m is of that order.
        EXPECT_LT(
            largestDifference(simulation.readPositions(), solver.positions()),
            1e-5 * longestStrand(groom));
    }
}

}  // namespace
}  // namespace hair::simulation
