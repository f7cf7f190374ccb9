#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/gpu_fixture.h"
#include "tests/simulation/closed_meshes.h"
#include "tests/simulation/gpu_simulation.h"
#include "tests/simulation/strands.h"

// Tests collisions of guides with bodies on the device.
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
    {Solver::position_based_rod},
    {Solver::augmented_mass_spring}};

SimulationSettings settingsFor(const Way& way) {
    SimulationSettings settings;
    settings.solver = way.solver;
    settings.parallelism = way.parallelism;
    return settings;
}

// A ball smaller than a segment lies beside the fifth vertex of the second of three strands.
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

// A segment's end is thrown at 20 m/s at a rod 2 mm thick. Without continuous collisions it would
// be 15 cm behind the rod after the substep. It stops at the margin from the rod.
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
        settings.material.youngs_modulus = 1.0f;  // makes `rod` limp
        settings.material.shear_modulus = 1.0f;
        settings.collision = {.margin = 0.001f, .continuous = true};
        settings.colliders = {
            {.a = {0.05f, -0.5f, 0.0f}, .b = {0.05f, -1.5f, 0.0f}, .radius = 0.001f}};
        const groom::Groom groom = straightGroom(1, 2, 1.0);
        Simulation simulation(device(), groom, settings, 1);
        std::vector<glm::vec3> before = groom.points;
        before[1].x -= 0.2f;
        simulation.setState(groom.points, before);
        advance(device(), simulation, 1);
        const glm::vec3 tip = simulation.readPositions()[1];
        EXPECT_NEAR(tip.x, 0.05 - 0.002, 2e-4);  // for kTouch and the roundness of the margin
        EXPECT_TRUE(simulation.readContacts()[1]);
        settings.collision.continuous = false;
        Simulation careless(device(), groom, settings, 1);
        careless.setState(groom.points, before);
        advance(device(), careless, 1);
        EXPECT_GT(careless.readPositions()[1].x, 0.15f) << "where its way does not count";
        settings.collision.continuous = true;
        // A vertex that misses the body flies on.
        settings.colliders = {
            {.a = {0.05f, -1.0f, 0.01f}, .b = {0.05f, -1.0f, 1.0f}, .radius = 0.001f}};
        Simulation free(device(), groom, settings, 1);
        free.setState(groom.points, before);
        advance(device(), free, 1);
        EXPECT_GT(free.readPositions()[1].x, 0.15f);
    }
}

// Returns strands that stand apart on the top of a ball.
groom::Groom hairOnABall(double radius) {
    groom::Groom groom{.strand_count = 12, .vertices_per_strand = 8};
    for (int s = 0; s < 12; ++s) {
        const double angle = 0.5 * s;
        const glm::dvec3 up =
            glm::normalize(glm::dvec3(0.3 * std::cos(angle), 1.0, 0.3 * std::sin(angle)));
        for (int v = 0; v < 8; ++v) groom.points.emplace_back((radius + 0.005 + 0.02 * v) * up);
    }
    return groom;
}

// Returns a nod and back, in a second.
MotionSettings nod() {
    return {
        .keyframes =
            {{.time = 0.0f}, {.time = 0.5f, .rotation = {30.0f, 20.0f, 0.0f}}, {.time = 1.0f}},
        .pivot = {0.0f, -0.1f, 0.0f}};
}

// Keeps the distance field that the first simulation of a mesh bakes, for the following ones.
class FieldOnce {
public:
    MadeBefore made() const { return {.fields = std::span(&known_, 1)}; }

    void keep(const Simulation& simulation) {
        if (known_) return;
        field_ = simulation.readField(0);
        known_ = &field_;
    }

private:
    BakedField field_;
    const BakedField* known_ = nullptr;
};

// Hair falls over a ball that nods with the head. The ball is the distance field of a mesh of 5,120
// triangles. With edges of r / 15 the middles of triangles lie 7.4e-4 r inside, which is 5.9e-5 m.
// Between grid points the field is off by at most 3/8 cell^2 / r, as its second derivatives are at
// most 1 / r: 1.2e-4 m with cells of 2 r / 32. The rest of the tolerance is for rounding.
TEST_F(GpuContact, KeepsHairOutOfAMovingField) {
    constexpr double kRadius = 0.08;
    constexpr float kMargin = 0.004f;
    constexpr double kField = 5.9e-5 + 1.2e-4 + 1e-6;
    const groom::Groom groom = hairOnABall(kRadius);
    const groom::Mesh sphere = makeSphere(glm::dvec3(0.0), kRadius, 4);
    FieldOnce field;
    for (const Way& way : kWays) {
        SCOPED_TRACE(nameOf(way));
        SimulationSettings settings = settingsFor(way);
        settings.collision = {.margin = kMargin, .friction = 0.2f};
        settings.motion = nod();
        settings.distance_fields = {{.mesh = "", .resolution = 32}};
        Simulation simulation(device(), groom, settings, 1, std::span(&sphere, 1), field.made());
        field.keep(simulation);
        // `shape` enforces lengths last, so hair presses into the margin.
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

// The same ball, once open below, like a head at the neck, and once open above. Above, hair falls
// on the opening, which is 13 cm wide, and lies on its cap. With 64 rings of 64 vertices, triangles
// lie up to ((2 pi / 64)^2 + (2.2 / 64)^2) / 8 r = 1.4e-3 r inside, 1.1e-4 m. Between grid points
// the field is off as above. Near the rim the error has the distance from the rim in place of the
// radius, and within two cells of it the error is at most a cell. Hair that falls at most 0.3 m
// from rest moves at most 4.1 cm in a step and the head 0.3 cm; a push out adds a cell. Without the
// cap the hair would jump 6.5 cm at the opening.
TEST_F(GpuContact, KeepsHairOutOfAMovingOpenField) {
    constexpr double kRadius = 0.08;
    constexpr float kMargin = 0.004f;
    constexpr double kField = 1.1e-4 + 1.2e-4 + 1e-6;
    constexpr double kCell = 2 * kRadius / 32;
    const groom::Groom groom = hairOnABall(kRadius);
    for (const bool open_above : {false, true}) {
        // The ball ends below at -0.5 r, or above at 0.58 r.
        groom::Mesh ball = makeOpenSphere({0, 0, 0}, kRadius, open_above ? 2.19 : 2.09, 64, 64);
        if (open_above)
            for (glm::vec3& p : ball.positions) p = {p.x, -p.y, -p.z};
        const double end = kRadius * (open_above ? -std::cos(2.19) : std::cos(2.09));
        const double rim = std::sqrt(kRadius * kRadius - end * end);
        FieldOnce field;
        for (const Way& way : kWays) {
            SCOPED_TRACE(nameOf(way) + (open_above ? " open above" : " open below"));
            SimulationSettings settings = settingsFor(way);
            settings.collision = {.margin = kMargin, .friction = 0.2f};
            settings.motion = nod();
            settings.distance_fields = {{.mesh = "", .resolution = 32}};
            // The ghost would hold the hair above the ball.
            settings.augmented_mass_spring.integrity = 0.0f;
            settings.augmented_mass_spring.angular_stiffness = 0.0f;
            Simulation simulation(device(), groom, settings, 1, std::span(&ball, 1), field.made());
            field.keep(simulation);
            const double pressed = settings.solver == Solver::shape ? double{kMargin} : 0.0;
            std::ptrdiff_t contacts = 0;
            std::vector<glm::vec3> before = simulation.readPositions();
            for (int i = 0; i < 60; ++i) {
                advance(device(), simulation, 1);
                const auto points = simulation.readPositions();
                for (std::size_t v = 0; v < points.size(); ++v) {
                    const RigidMotion pose = simulation.pose();
                    const glm::dvec3 p =
                        glm::conjugate(pose.rotation) * (glm::dvec3(points[v]) - pose.translation);
                    const double past_end = open_above ? p.y - end : end - p.y;
                    const double outside = std::max(glm::length(p) - kRadius, past_end);
                    const double from_rim = std::hypot(std::hypot(p.x, p.z) - rim, p.y - end);
                    const double off =
                        from_rim < 2 * kCell ? kCell : kField + 3 * kCell * kCell / (8 * from_rim);
                    ASSERT_GT(outside, double{kMargin} - pressed - off)
                        << "vertex " << v << " in step " << i;
                    ASSERT_LT(glm::distance(points[v], before[v]), 0.044 + kCell)
                        << "vertex " << v << " in step " << i;
                }
                before = points;
                contacts += std::ranges::count(simulation.readContacts(), true);
            }
            EXPECT_GT(contacts, 0);
        }
    }
}

}  // namespace
}  // namespace hair::simulation
