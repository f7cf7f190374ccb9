#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "tests/gpu_fixture.h"
#include "tests/simulation/closed_meshes.h"
#include "tests/simulation/gpu_simulation.h"
#include "tests/simulation/strands.h"

// Bodies and guides together, on the device.
namespace hair::simulation {
namespace {

using GpuContact = GpuTest;

struct Way {
    Solver solver;
    Parallelism parallelism = Parallelism::automatic;
};

std::string nameOf(const Way& way) {
    return std::string("solver ") + std::to_string(static_cast<int>(way.solver)) + " parallelism " +
           std::to_string(static_cast<int>(way.parallelism));
}

constexpr Way kWays[] = {
    {Solver::shape, Parallelism::vertex},
    {Solver::shape, Parallelism::strand},
    {Solver::shape, Parallelism::serial},
    {Solver::ftl},
    {Solver::rod}};

SimulationSettings settingsFor(const Way& way) {
    SimulationSettings settings;
    settings.solver = way.solver;
    settings.parallelism = way.parallelism;
    return settings;
}

// A ball that is smaller than a segment, beside the fifth vertex of the second of three strands.
TEST_F(GpuContact, MarksTheVertexThatTouchesAndAllBelow) {
    const groom::Groom groom = straightGroom(3, 9);
    const std::uint32_t touching = 9 + 4;
    for (const Way& way : kWays) {
        SCOPED_TRACE(nameOf(way));
        SimulationSettings settings = settingsFor(way);
        settings.gravity = glm::vec3(0.0f);
        settings.substeps = 1;  // a later one may find it clear of the ball
        const glm::vec3 centre = groom.points[touching] + glm::vec3(0.002f, 0.0f, 0.0f);
        settings.colliders = {{.a = centre, .b = centre, .radius = 0.005f}};
        Simulation simulation(device(), groom, settings, 1);
        const auto none = simulation.readContacts();
        EXPECT_EQ(std::ranges::count(none, true), 0);
        advance(device(), simulation, 1);
        const auto contacts = simulation.readContacts();
        for (std::uint32_t i = 0; i < contacts.size(); ++i)
            EXPECT_EQ(contacts[i], i >= touching && i < 2 * 9) << "vertex " << i;
    }
}

// A segment's end that is thrown at 20 m/s at a rod of 2 mm, and would be 20 cm behind it after the
// substep: it stops at the rod, at the margin from it, and slides no farther along it than it came.
TEST_F(GpuContact, StopsWhatWouldFlyThroughAThinBody) {
    for (const Way& way : kWays) {
        SCOPED_TRACE(nameOf(way));
        SimulationSettings settings = settingsFor(way);
        settings.gravity = glm::vec3(0.0f);
        settings.substeps = 1;
        settings.time_step = 0.01f;
        settings.friction = 0.0f;
        settings.global.stiffness = 0.0f;
        settings.local.stiffness = 0.0f;
        settings.material.youngs_modulus = 1.0f;  // of `rod`: limp
        settings.material.shear_modulus = 1.0f;
        settings.collision = {.margin = 0.001f, .continuous = true};
        settings.colliders = {
            {.a = {0.05f, -1.0f, -1.0f}, .b = {0.05f, -1.0f, 1.0f}, .radius = 0.001f},
            {.a = {0.05f, -0.9f, 0.0f}, .b = {0.05f, -1.1f, 0.0f}, .radius = 0.001f}};
        const groom::Groom groom = straightGroom(1, 2, 1.0);
        Simulation simulation(device(), groom, settings, 1);
        std::vector<glm::vec3> before = groom.points;
        before[1].x -= 0.2f;
        simulation.setState(groom.points, before);
        advance(device(), simulation, 1);
        const glm::vec3 tip = simulation.readPositions()[1];
        EXPECT_NEAR(tip.x, 0.05 - 0.002, 2e-4);  // of kTouch, and of the margin's roundness
        EXPECT_NEAR(tip.y, -1.0, 0.03) << "it swings by 0.2 rad";
        EXPECT_TRUE(simulation.readContacts()[1]);
        settings.collision.continuous = false;
        Simulation careless(device(), groom, settings, 1);
        careless.setState(groom.points, before);
        advance(device(), careless, 1);
        EXPECT_GT(careless.readPositions()[1].x, 0.15f) << "where its way does not count";
        settings.collision.continuous = true;
        // What would not have met it flies on.
        settings.colliders = {
            {.a = {0.05f, -1.0f, 0.01f}, .b = {0.05f, -1.0f, 1.0f}, .radius = 0.001f}};
        Simulation free(device(), groom, settings, 1);
        free.setState(groom.points, before);
        advance(device(), free, 1);
        EXPECT_GT(free.readPositions()[1].x, 0.15f);
    }
}

// Hair that falls over a ball which nods with the head, and which is the distance field of a mesh
// of 5,120 triangles: with edges of r / 15 their middles lie 7.4e-4 r inside, which is 5.9e-5 m.
// Between its points the field is off by at most 3/8 cell^2 / r (its second derivatives are 1 / r
// at most): 1.2e-4 m with cells of 2 r / 32. The rest is for rounding.
TEST_F(GpuContact, KeepsHairOutOfAMovingField) {
    constexpr double kRadius = 0.08;
    constexpr float kMargin = 0.004f;
    constexpr double kField = 5.9e-5 + 1.2e-4 + 1e-6;
    groom::Groom groom{.strand_count = 12, .vertices_per_strand = 8};
    for (int s = 0; s < 12; ++s) {
        const double angle = 0.5 * s;
        const glm::dvec3 up =
            glm::normalize(glm::dvec3(0.3 * std::cos(angle), 1.0, 0.3 * std::sin(angle)));
        for (int v = 0; v < 8; ++v) groom.points.emplace_back((kRadius + 0.005 + 0.02 * v) * up);
    }
    const groom::Mesh sphere = makeSphere(glm::dvec3(0.0), kRadius, 4);
    for (const Way& way : kWays) {
        SCOPED_TRACE(nameOf(way));
        SimulationSettings settings = settingsFor(way);
        settings.collision = {.margin = kMargin, .friction = 0.2f};
        settings.motion.keyframes = {
            {.time = 0.0f}, {.time = 0.5f, .rotation = {30.0f, 20.0f, 0.0f}}, {.time = 1.0f}};
        settings.motion.pivot = {0.0f, -0.1f, 0.0f};
        settings.distance_fields = {{.mesh = "", .resolution = 32}};
        Simulation simulation(device(), groom, settings, 1, std::span(&sphere, 1));
        // Where lengths have the last word hair presses into the margin.
        const double pressed = settings.solver == Solver::shape ? double{kMargin} : 0.0;
        std::ptrdiff_t contacts = 0;
        for (int i = 0; i < 60; ++i) {
            advance(device(), simulation, 1);
            const glm::dvec3 centre = simulation.pose()(glm::dvec3(0.0));
            const auto points = simulation.readPositions();
            for (std::size_t v = 0; v < points.size(); ++v)
                ASSERT_GT(
                    glm::distance(glm::dvec3(points[v]), centre),
                    kRadius + kMargin - pressed - kField)
                    << "vertex " << v << " in step " << i;
            contacts += std::ranges::count(simulation.readContacts(), true);
        }
        EXPECT_GT(contacts, 0);  // it did fall on the ball
    }
}

}  // namespace
}  // namespace hair::simulation
