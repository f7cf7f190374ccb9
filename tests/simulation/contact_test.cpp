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
    {Solver::rod},
    {Solver::stable_cosserat},
    {Solver::position_based_rod}};

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
