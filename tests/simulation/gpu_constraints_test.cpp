#include <gtest/gtest.h>

#include "hair/reference/solvers.h"
#include "tests/gpu_fixture.h"
#include "tests/simulation/gpu_simulation.h"
#include "tests/simulation/parallelisms.h"
#include "tests/simulation/strands.h"

// Tests each pass and constraint alone: one step on the device against the reference in double
// precision.
namespace hair::simulation {
namespace {

// Relative to the strand's length. A float position near 1 m is stored to 6e-8, and an iteration
// rounds it a few times. The local constraint at full stiffness enlarges that most, because its
// goals depend on all segments above.
constexpr double kTolerance = 1e-5;

struct Shape {
    std::uint32_t strands;
    std::uint32_t vertices;
};

// Counts that fill a work group, that leave invocations over, and that leave a work group almost
// empty; strands of one chunk and of several, full and not. Each number of vertices is a kernel of
// its own, which takes longer to compile than to run.
constexpr Shape kShapes[] = {{1, 2}, {33, 2}, {5, 3}, {86, 8}, {7, 9}, {3, 33}, {2, 256}};

class GpuConstraints : public GpuTest, public testing::WithParamInterface<Parallelism> {
protected:
    static void expectReference(SimulationSettings settings) {
        settings.parallelism = GetParam();
        for (const Shape& shape : kShapes) {
            const groom::Groom groom = wavyGroom(shape.strands, shape.vertices);
            const auto positions = disturbed(groom, 0.3 * kReferenceSegment, 11);
            const auto previous = disturbed(groom, 0.3 * kReferenceSegment, 12);
            Simulation simulation(device(), groom, settings, 5);
            reference::Reference solver(groom, settings, 5);
            simulation.setState(positions, previous);
            solver.setState(toDouble(positions), toDouble(previous));
            advance(device(), simulation, 1);
            solver.step();
            const double error = largestDifference(simulation.readPositions(), solver.positions()) /
                                 longestStrand(groom);
            EXPECT_LT(error, kTolerance) << shape.strands << " strands of " << shape.vertices;
        }
    }
};

// Friction takes all velocity, so that only the constraint moves anything.
SimulationSettings atRest() {
    SimulationSettings settings = nothingActs();
    settings.friction = 1.0f;
    return settings;
}

TEST_P(GpuConstraints, IntegratesLikeTheReference) {
    SimulationSettings settings = nothingActs();
    settings.gravity = {1.0f, -9.8f, 3.0f};
    settings.friction = 0.05f;
    expectReference(settings);
    settings.time_step = 0.1f;
    expectReference(settings);
}

TEST_P(GpuConstraints, BlowsLikeTheReference) {
    SimulationSettings settings = nothingActs();
    settings.time_step = 0.1f;
    settings.wind = {.strength = 15.0f, .direction = {0.3f, -1.0f, 0.5f}, .cone_angle = 35.0f};
    expectReference(settings);
}

TEST_P(GpuConstraints, PullsToRestLikeTheReference) {
    SimulationSettings settings = atRest();
    for (const float stiffness : {0.002f, 0.5f, 1.0f}) {
        settings.global.stiffness = stiffness;
        expectReference(settings);
    }
}

TEST_P(GpuConstraints, PullsToShapeLikeTheReference) {
    SimulationSettings settings = atRest();
    for (const StiffnessScaling scaling : {StiffnessScaling::thesis, StiffnessScaling::invariant})
        for (const std::uint32_t iterations : {1u, 2u, 10u})
            for (const float stiffness : {0.01f, 0.3f, 1.0f}) {
                settings.stiffness_scaling = scaling;
                settings.local = {.stiffness = stiffness, .iterations = iterations};
                expectReference(settings);
            }
}

TEST_P(GpuConstraints, KeepsLengthsLikeTheReference) {
    SimulationSettings settings = atRest();
    for (const LengthMethod method : {LengthMethod::tridiagonal, LengthMethod::iterate})
        for (const std::uint32_t iterations : {1u, 2u, 5u, 100u}) {
            SCOPED_TRACE(static_cast<int>(method));
            settings.length = {.method = method, .iterations = iterations};
            expectReference(settings);
        }
}

TEST_P(GpuConstraints, CollidesLikeTheReference) {
    SimulationSettings settings = atRest();
    settings.colliders = {
        {.a = {-0.1f, 0, 0}, .b = {0.1f, 0.05f, 0}, .radius = 0.08f},
        {.a = {0, 0.1f, 0.1f}, .b = {0, 0.1f, 0.1f}, .radius = 0.1f}};
    expectReference(settings);
    settings.collision = {.margin = 0.01f, .friction = 0.25f};
    expectReference(settings);
}

FOR_EVERY_PARALLELISM(GpuConstraints);

}  // namespace
}  // namespace hair::simulation
