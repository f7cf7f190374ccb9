#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/error.h"
#include "tests/gpu_fixture.h"
#include "tests/simulation/closed_meshes.h"
#include "tests/simulation/gpu_simulation.h"
#include "tests/simulation/strands.h"

// Tests segments of guides against bodies that their vertices miss.
namespace hair::simulation {
namespace {

using GpuSegmentContact = GpuTest;

constexpr Solver kKeepSegmentsOut[] = {Solver::shape, Solver::ftl, Solver::rod};
constexpr double kThin = 0.0015;  // radius of the thin capsule, m
constexpr double kSegment = 0.015;  // m
constexpr double kDepth = 1e-4;  // m, greatest depth of a segment in a body after a step

// Returns settings for a limp strand: a chain of `shape` and `ftl`, and a hair a thousandth as
// stiff as a real one.
SimulationSettings limp(Solver solver) {
    SimulationSettings settings;
    settings.solver = solver;
    settings.global.stiffness = 0.0f;
    settings.local.stiffness = 0.0f;
    settings.material.youngs_modulus = 3.9e6f;
    settings.material.shear_modulus = 0.6e6f;
    settings.collision.parts = CollisionParts::segments;
    return settings;
}

std::string nameOfSolver(Solver solver) {
    return "solver " + std::to_string(static_cast<int>(solver));
}

groom::Groom levelStrand(const glm::dvec3& root, std::uint32_t vertices) {
    groom::Groom groom{.strand_count = 1, .vertices_per_strand = vertices};
    for (std::uint32_t v = 0; v < vertices; ++v)
        groom.points.emplace_back(root + glm::dvec3(kSegment * v, 0.0, 0.0));
    return groom;
}

// Returns the depth of segments in a body by sampling them at 1/200 of their length.
template <class Gap>
double deepest(const std::vector<glm::vec3>& points, const Gap& gap) {
    double least = 1e9;
    for (std::size_t v = 1; v < points.size(); ++v)
        for (int k = 0; k <= 200; ++k)
            least = std::min(
                least, gap(glm::mix(glm::dvec3(points[v - 1]), glm::dvec3(points[v]), k / 200.0)));
    return -least;
}

double gapToCapsule(const glm::dvec3& place) { return std::hypot(place.x, place.y) - kThin; }

Collider thinCapsule() {
    return {.a = {0.0f, 0.0f, -0.2f}, .b = {0.0f, 0.0f, 0.2f}, .radius = static_cast<float>(kThin)};
}

// Eleven vertices lie over a capsule 3 mm thick. The strand is clamped 5 cm beside the capsule and
// reaches beyond it. With collisions of vertices alone it falls through.
TEST_F(GpuSegmentContact, StrandHangsOverAThinCapsule) {
    for (const Solver solver : kKeepSegmentsOut)
        for (const float friction : {0.0f, 0.3f}) {
            SCOPED_TRACE(nameOfSolver(solver) + " friction " + std::to_string(friction));
            SimulationSettings settings = limp(solver);
            settings.collision.friction = friction;
            settings.colliders = {thinCapsule()};
            const groom::Groom groom = levelStrand({-0.05, 0.003, 0.0}, 11);
            Simulation simulation(device(), groom, settings, 1);
            double depth = -1.0;
            for (int i = 0; i < 300; ++i) {
                advance(device(), simulation, 1);
                depth = std::max(depth, deepest(simulation.readPositions(), gapToCapsule));
            }
            EXPECT_LT(depth, kDepth);
            const auto before = simulation.readPositions();
            EXPECT_GT(before[10].x, 0.0f) << "it slipped off";
            EXPECT_LT(before[10].y, -0.05f) << "it does not hang";
            EXPECT_TRUE(simulation.readContacts()[10]);
            advance(device(), simulation, 6);
            const auto after = simulation.readPositions();
            for (std::size_t v = 0; v < after.size(); ++v)
                EXPECT_LT(glm::distance(before[v], after[v]), 2e-3f) << "vertex " << v;

            settings.collision.parts = CollisionParts::vertices;
            Simulation careless(device(), groom, settings, 1);
            advance(device(), careless, 300);
            EXPECT_LT(careless.readPositions()[10].x, -0.02f) << "where vertices alone count";
        }
}

// Statics of that strand at rest, with masses 1 under gravity 1, computed from its positions. The
// segment on the capsule is a lever: the weight below pulls at one end, a tension along the segment
// above at the other, and the capsule pushes between them. Forces and moments are in balance.
struct Lever {
    double pressure = 0.0;
    double shear = 0.0;
    double tension = 0.0;  // of the segment above
    double off = 0.0;  // sine of the greatest angle between a segment and its tension
};

double crossOf(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.y - a.y * b.x; }

Lever leverOf(const std::vector<glm::vec3>& points) {
    std::size_t b = 0;  // last vertex of the lever
    double nearest = 1e9;
    for (std::size_t v = 1; v < points.size(); ++v) {
        const double gap = -deepest({points[v - 1], points[v]}, gapToCapsule);
        if (gap < nearest) {
            nearest = gap;
            b = v;
        }
    }
    const auto direction = [&](std::size_t v) {
        return glm::normalize(glm::dvec3(points[v]) - glm::dvec3(points[v - 1]));
    };
    Lever lever;
    const glm::dvec3 up = direction(b - 1);
    const glm::dvec3 along = direction(b);
    const glm::dvec3 normal(-along.y, along.x, 0.0);
    const double arm = -glm::dot(glm::dvec3(points[b - 1]), along);  // of the capsule's push
    const double length = glm::distance(points[b - 1], points[b]);
    const glm::dvec3 weight_b(0.0, -static_cast<double>(points.size() - b), 0.0);
    const glm::dvec3 weight_a(0.0, -1.0, 0.0);
    lever.pressure = -length * crossOf(along, weight_b) / arm;
    // weight_a + weight_b + pressure normal + shear along - tension up = 0
    const glm::dvec3 rest = weight_a + weight_b + lever.pressure * normal;
    lever.tension = crossOf(rest, along) / crossOf(up, along);
    lever.shear = glm::dot(lever.tension * up - rest, along);
    glm::dvec3 pull = lever.tension * up;
    for (std::size_t v = b - 2; v > 0; --v) {
        pull += glm::dvec3(0.0, -1.0, 0.0);
        lever.off = std::max(lever.off, std::abs(crossOf(pull, direction(v))) / glm::length(pull));
    }
    return lever;
}

// A step moves a strand by g h^2 and takes it back along segments that have turned meanwhile. So a
// resting strand is off balance by the angle g h^2 / segment length, times the number of vertices
// that hang: 0.011 at 1/240 s for each of the six, and a quarter of that at 1/480 s.
TEST_F(GpuSegmentContact, StrandOfShapeIsInBalanceOnAThinCapsule) {
    for (const std::uint32_t substeps : {4u, 8u}) {
        SCOPED_TRACE(substeps);
        SimulationSettings settings = limp(Solver::shape);
        settings.substeps = substeps;
        settings.collision.friction = 0.3f;
        settings.colliders = {thinCapsule()};
        Simulation simulation(device(), levelStrand({-0.05, 0.003, 0.0}, 11), settings, 1);
        advance(device(), simulation, 600);
        const Lever lever = leverOf(simulation.readPositions());
        const double step = settings.time_step / substeps;
        EXPECT_GT(lever.tension, 0.0);
        EXPECT_LT(lever.off, 6.0 * 9.8 * step * step / kSegment);
        EXPECT_LE(std::abs(lever.shear), double{settings.collision.friction} * lever.pressure);
    }
}

// The same strand starts at rest. It stays if friction exceeds the shear that balance needs over
// the pressure, and slips if friction is less. That is the capstan equation for a polygon with one
// side on the capstan.
TEST_F(GpuSegmentContact, StrandOfShapeSlipsByCoulombsLaw) {
    SimulationSettings settings = limp(Solver::shape);
    settings.substeps = 8;
    settings.collision.friction = 0.3f;
    settings.colliders = {thinCapsule()};
    groom::Groom groom = levelStrand({-0.05, 0.003, 0.0}, 11);
    Simulation first(device(), groom, settings, 1);
    advance(device(), first, 600);
    groom.points = first.readPositions();
    const Lever lever = leverOf(groom.points);
    const double critical = std::abs(lever.shear) / lever.pressure;
    ASSERT_GT(critical, 0.0);
    for (const double part : {0.5, 0.9, 1.1, 2.0}) {
        SCOPED_TRACE(part);
        settings.collision.friction = static_cast<float>(part * critical);
        Simulation simulation(device(), groom, settings, 1);
        advance(device(), simulation, 120);
        const auto points = simulation.readPositions();
        float moved = 0.0f;
        for (std::size_t v = 0; v < points.size(); ++v)
            moved = std::max(moved, glm::distance(points[v], groom.points[v]));
        // A held strand moves by at most two roundings of positions some cm from the origin; a
        // slipping one by far more.
        if (part > 1.0)
            EXPECT_LT(moved, 1e-6f);
        else
            EXPECT_GT(moved, 5e-6f);
    }
}

// The strand falls 2 cm onto a sphere 4 mm thick between two of its vertices, and meets it at 0.6
// m/s.
TEST_F(GpuSegmentContact, LevelStrandMeetsASphereSmallerThanItsSegment) {
    for (const Solver solver : kKeepSegmentsOut) {
        SCOPED_TRACE(nameOfSolver(solver));
        SimulationSettings settings = limp(solver);
        settings.collision.friction = 0.3f;
        settings.colliders = {{.radius = 0.002f}};
        Simulation simulation(device(), levelStrand({-2.5 * kSegment, 0.022, 0.0}, 8), settings, 1);
        double depth = -1.0;
        bool touched = false;
        for (int i = 0; i < 120; ++i) {
            advance(device(), simulation, 1);
            depth =
                std::max(depth, deepest(simulation.readPositions(), [](const glm::dvec3& place) {
                             return glm::length(place) - 0.002;
                         }));
            touched = touched || simulation.readContacts()[7];
        }
        EXPECT_TRUE(touched);
        EXPECT_LT(depth, kDepth);
    }
}

// The tip of a segment is thrown at 20 m/s past a capsule that neither end meets.
TEST_F(GpuSegmentContact, StopsASegmentThatWouldSweepThrough) {
    for (const Solver solver : kKeepSegmentsOut) {
        SCOPED_TRACE(nameOfSolver(solver));
        SimulationSettings settings = limp(solver);
        settings.gravity = glm::vec3(0.0f);
        settings.substeps = 1;
        settings.time_step = 0.01f;
        settings.friction = 0.0f;
        settings.colliders = {
            {.a = {0.05f, -0.7f, -0.5f}, .b = {0.05f, -0.7f, 0.5f}, .radius = 0.001f}};
        const groom::Groom groom = straightGroom(1, 2, 1.0);
        std::vector<glm::vec3> before = groom.points;
        before[1].x -= 0.2f;
        Simulation simulation(device(), groom, settings, 1);
        simulation.setState(groom.points, before);
        advance(device(), simulation, 1);
        // The segment is then tangent to the capsule.
        const glm::dvec3 tip = simulation.readPositions()[1];
        const double far = std::hypot(0.05, 0.7);
        const double angle = std::atan2(0.05, 0.7) - std::asin(0.001 / far);
        EXPECT_NEAR(std::atan2(tip.x, -tip.y), angle, 5e-3);
        EXPECT_TRUE(simulation.readContacts()[1]);
        settings.collision.parts = CollisionParts::vertices;
        Simulation careless(device(), groom, settings, 1);
        careless.setState(groom.points, before);
        advance(device(), careless, 1);
        EXPECT_GT(careless.readPositions()[1].x, 0.15f) << "where vertices alone count";
    }
}

// A slab 2 mm thick stands on edge, in a field with cells of 0.47 mm. The interpolated edge lies
// less than half a cell inside the slab's. Vertices that swing at its side do not fly through it.
TEST_F(GpuSegmentContact, StrandHangsOverTheEdgeOfAThinSlab) {
    constexpr double kLow = -0.12;
    const groom::Mesh slab = makeBox({-0.001, kLow, -0.03}, {0.001, 0.0, 0.03});
    for (const Solver solver : kKeepSegmentsOut) {
        SCOPED_TRACE(nameOfSolver(solver));
        SimulationSettings settings = limp(solver);
        settings.collision.friction = 0.3f;
        settings.collision.continuous = true;
        settings.distance_fields = {{.mesh = "", .resolution = 256}};
        Simulation simulation(
            device(), levelStrand({-0.05, 0.003, 0.0}, 11), settings, 1, std::span(&slab, 1));
        double depth = -1.0;
        for (int i = 0; i < 300; ++i) {
            advance(device(), simulation, 1);
            depth =
                std::max(depth, deepest(simulation.readPositions(), [](const glm::dvec3& place) {
                             return std::max({std::abs(place.x) - 0.001, place.y, kLow - place.y});
                         }));
        }
        EXPECT_LT(depth, 0.5 * -kLow / 256);
        const auto points = simulation.readPositions();
        EXPECT_GT(points[10].x, 0.0f) << "it slipped off";
        EXPECT_LT(points[10].y, -0.05f) << "it does not hang";
    }
}

// The vertices of the hair lie on a ball, so the segments between lie in it by up to L^2 / 8 r =
// 0.35 mm. Balanced hair stays there, and other hair is pushed out.
TEST_F(GpuSegmentContact, BalancedHairIsPushedNoFartherOutThanItLies) {
    constexpr double kRadius = 0.08;
    groom::Groom groom{.strand_count = 1, .vertices_per_strand = 8};
    for (int v = 0; v < 8; ++v) {
        const double angle = 0.3 + kSegment / kRadius * v;
        groom.points.emplace_back(
            (kRadius + 2e-5) * glm::dvec3(std::sin(angle), std::cos(angle), 0.0));
    }
    for (const Solver solver : {Solver::shape, Solver::rod}) {
        SCOPED_TRACE(nameOfSolver(solver));
        SimulationSettings settings;
        settings.solver = solver;
        settings.collision.parts = CollisionParts::segments;
        settings.colliders = {{.radius = static_cast<float>(kRadius)}};
        const auto movedIn = [&](RestShape rest) {
            settings.rest = rest;
            Simulation simulation(device(), groom, settings, 1);
            advance(device(), simulation, 60);
            float moved = 0.0f;
            const auto points = simulation.readPositions();
            for (std::size_t v = 0; v < points.size(); ++v)
                moved = std::max(moved, glm::distance(points[v], groom.points[v]));
            return moved;
        };
        EXPECT_LT(movedIn(RestShape::balanced), 1e-5f);
        EXPECT_GT(movedIn(RestShape::groom), 1e-4f);
    }
}

// The strands are near a capsule but touch nothing: results with and without segments are equal to
// the bit.
TEST_F(GpuSegmentContact, ChangesNothingWhereNoSegmentTouches) {
    const groom::Groom groom = straightGroom(3, 9);
    for (const Solver solver : kKeepSegmentsOut) {
        SCOPED_TRACE(nameOfSolver(solver));
        SimulationSettings settings;
        settings.solver = solver;
        settings.colliders = {
            {.a = {0.0f, 0.1f, 0.02f}, .b = {0.0f, -1.0f, 0.02f}, .radius = 0.01f}};
        settings.motion = {
            .keyframes = {{.time = 0.0f}, {.time = 0.5f, .rotation = {0.0f, 0.0f, 20.0f}}}};
        Simulation vertices(device(), groom, settings, 1);
        settings.collision.parts = CollisionParts::segments;
        Simulation segments(device(), groom, settings, 1);
        for (int i = 0; i < 20; ++i) {
            advance(device(), vertices, 1);
            advance(device(), segments, 1);
            ASSERT_EQ(vertices.readPositions(), segments.readPositions()) << "step " << i;
        }
        const auto contacts = segments.readContacts();
        EXPECT_EQ(std::ranges::count(contacts, true), 0);
    }
}

TEST_F(GpuSegmentContact, OtherSolversRefuse) {
    for (const Solver solver : kSolvers) {
        if (std::ranges::find(kKeepSegmentsOut, solver) != std::end(kKeepSegmentsOut)) continue;
        SCOPED_TRACE(nameOfSolver(solver));
        EXPECT_THROW(Simulation(device(), straightGroom(1, 4), limp(solver), 1), engine::Error);
    }
}

}  // namespace
}  // namespace hair::simulation
