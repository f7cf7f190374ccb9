#include "hair/simulation/probes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "hair/simulation/simulation.h"
#include "tests/error_text.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/simulation/gpu_simulation.h"
#include "tests/simulation/rods.h"
#include "tests/simulation/strands.h"

// Probes against theory. Unless a test says otherwise, tolerances are those of positions in 32
// bits: 1e-6 of the quantity for sums of a few dozen products, each rounded by 6e-8.
namespace hair::simulation {
namespace {

constexpr double kRounding = 1e-6;
constexpr double kProbedStep = 1.0 / 64.0;  // s, exact in 32 bits

ProbeSettings all() {
    return {
        .tip_displacement = true,
        .groom_distance = true,
        .length_error = true,
        .energy = true,
        .contact = true,
        .speed = true,
        .bending = true,
        .torsion = true,
        .momentum = true};
}

SimulationSettings still() {
    SimulationSettings settings = nothingActs();
    settings.time_step = static_cast<float>(kProbedStep);
    return settings;
}

groom::Groom oneGuide(const std::vector<glm::dvec3>& points) {
    return {
        .strand_count = 1,
        .vertices_per_strand = static_cast<std::uint32_t>(points.size()),
        .points = {points.begin(), points.end()}};
}

const double kLineDensity = lineDensity(reference::RodMaterial{});  // kg/m

class GuideProbes : public GpuTest {
protected:
    using Frame = std::map<std::string, double>;

    static Frame lastOf(const Probes& probes, const std::vector<std::string>& names) {
        const auto values = probes.read();
        EXPECT_EQ(values.size(), names.size());
        Frame frame;
        for (std::size_t i = 0; i < names.size(); ++i) frame[names[i]] = values[i].back();
        return frame;
    }

    static Frame probed(
        const Simulation& simulation, const groom::Groom& groom, const SimulationSettings& settings,
        const ProbeSettings& wanted = all(), const groom::StrandSet* reference = nullptr) {
        Probes probes(device(), groom, settings, wanted, 1, reference);
        runOnce(device(), [&](engine::Commands& commands) {
            probes.record(commands, simulation.recordProbed(commands));
        });
        return lastOf(probes, Probes::names(wanted, settings.solver));
    }

    // Returns the probes of guides that are at `points` and were at `before` a substep earlier.
    static Frame probedAt(
        const groom::Groom& groom, const SimulationSettings& settings,
        const std::vector<glm::vec3>& points, const std::vector<glm::vec3>& before,
        const ProbeSettings& wanted = all(), const groom::StrandSet* reference = nullptr) {
        Simulation simulation(device(), groom, settings, 1);
        simulation.setState(points, before);
        return probed(simulation, groom, settings, wanted, reference);
    }
};

TEST_F(GuideProbes, AreZeroAtRest) {
    const groom::Groom groom = straightGroom(5, 6);
    const Frame frame = probed(Simulation(device(), groom, still(), 1), groom, still());
    EXPECT_EQ(frame.size(), 20u);  // without elastic energy, which `shape` lacks
    // Rest lengths and directions are rounded alike, and the hair is straight.
    for (const auto& [name, value] : frame) EXPECT_EQ(value, 0.0) << name;
}

// Tips are moved by 1, 2 ... 10 mm in any order. Half of the guides are within 5 mm, and nine of
// ten within 9 mm.
TEST_F(GuideProbes, GiveTheDisplacementOfTips) {
    const groom::Groom groom = straightGroom(10, 4);
    std::vector<glm::vec3> points = groom.points;
    const int order[] = {7, 3, 10, 1, 9, 2, 8, 4, 6, 5};
    for (std::size_t s = 0; s < 10; ++s)
        points[4 * s + 3] += 1e-3f * static_cast<float>(order[s]) * glm::vec3(0.6f, 0.0f, 0.8f);
    const Frame frame = probedAt(groom, still(), points, points);
    constexpr double kTolerance = 6e-8;  // m, roundings of positions up to 0.5 m
    EXPECT_NEAR(frame.at("tip_displacement.mean"), 5.5e-3, kTolerance);
    EXPECT_NEAR(frame.at("tip_displacement.median"), 5e-3, kTolerance);
    EXPECT_NEAR(frame.at("tip_displacement.percentile_90"), 9e-3, kTolerance);
    EXPECT_NEAR(frame.at("tip_displacement.maximum"), 10e-3, kTolerance);
}

// Hair that is moved by d is d from its groom everywhere. Two guides lean: vertex i of the first is
// 3 i mm from the groom, and that of the second 6 i mm. Without roots the means are 6 and 12 mm.
TEST_F(GuideProbes, GiveTheDistanceFromTheGroom) {
    const groom::Groom groom = straightGroom(2, 4);
    constexpr double kTolerance = 6e-8;  // m, roundings of positions up to 0.5 m
    std::vector<glm::vec3> moved = groom.points;
    for (glm::vec3& point : moved) point += glm::vec3(0.003f, 0.0f, -0.004f);
    Frame frame = probedAt(groom, still(), moved, moved);
    EXPECT_NEAR(frame.at("groom_distance.mean"), 5e-3, kTolerance);
    EXPECT_NEAR(frame.at("groom_distance.maximum"), 5e-3, kTolerance);
    std::vector<glm::vec3> leaning = groom.points;
    for (std::size_t s = 0; s < 2; ++s)
        for (std::size_t i = 0; i < 4; ++i)
            leaning[4 * s + i].z += 3e-3f * static_cast<float>((s + 1) * i);
    frame = probedAt(groom, still(), leaning, leaning);
    EXPECT_NEAR(frame.at("groom_distance.mean"), 9e-3, kTolerance);
    EXPECT_NEAR(frame.at("groom_distance.maximum"), 18e-3, kTolerance);
    EXPECT_NEAR(frame.at("tip_displacement.maximum"), 18e-3, kTolerance);
    // To leaning strands as the reference, hair at rest has the same distances, and leaning hair
    // none; its tips are still where they were.
    const groom::StrandSet reference{.ends = {4, 8}, .points = leaning};
    ProbeSettings wanted = all();
    wanted.reference = "leaning.ply";
    frame = probedAt(groom, still(), groom.points, groom.points, wanted, &reference);
    EXPECT_NEAR(frame.at("groom_distance.mean"), 9e-3, kTolerance);
    EXPECT_NEAR(frame.at("groom_distance.maximum"), 18e-3, kTolerance);
    frame = probedAt(groom, still(), leaning, leaning, wanted, &reference);
    EXPECT_NEAR(frame.at("groom_distance.maximum"), 0.0, kTolerance);
    EXPECT_NEAR(frame.at("tip_displacement.maximum"), 18e-3, kTolerance);
}

TEST_F(GuideProbes, CountOnlyTheWantedGuides) {
    const groom::Groom groom = straightGroom(6, 3);
    std::vector<glm::vec3> points = groom.points;
    for (std::size_t s = 0; s < 6; ++s) points[3 * s + 2].z += 0.01f * static_cast<float>(s);
    ProbeSettings wanted{.tip_displacement = true, .first_guide = 2, .guides = 3};
    Frame frame = probedAt(groom, still(), points, points, wanted);
    EXPECT_NEAR(frame.at("tip_displacement.mean"), 0.03, kRounding * 0.03);
    EXPECT_NEAR(frame.at("tip_displacement.maximum"), 0.04, kRounding * 0.04);
    wanted.guides = 0;  // up to the last
    frame = probedAt(groom, still(), points, points, wanted);
    EXPECT_NEAR(frame.at("tip_displacement.mean"), 0.035, kRounding * 0.035);
}

TEST_F(GuideProbes, RefuseGuidesThatTheGroomLacks) {
    const groom::Groom groom = straightGroom(6, 3);
    const auto make = [&](const ProbeSettings& wanted) {
        Probes(device(), groom, still(), wanted, 1);
    };
    EXPECT_EQ(
        errorText([&] { make({.speed = true, .first_guide = 6}); }),
        "/run/probes/first_guide: 6 is beyond the 6 guides");
    EXPECT_EQ(
        errorText([&] { make({.speed = true, .first_guide = 4, .guides = 3}); }),
        "/run/probes/guides: 3 is beyond the 6 guides");
}

// A guide of three segments: the first is right, the second 10 % too long, the third 20 % too
// short.
TEST_F(GuideProbes, GiveErrorsOfLengths) {
    const groom::Groom groom = straightGroom(1, 4, 0.1);
    const std::vector<glm::vec3> points{{0, 0, 0}, {0.1f, 0, 0}, {0.21f, 0, 0}, {0.29f, 0, 0}};
    const Frame frame = probedAt(groom, still(), points, points);
    // Lengths are differences of positions up to 0.3 m.
    EXPECT_NEAR(frame.at("length_error.mean"), 0.1, 3e-7);
    EXPECT_NEAR(frame.at("length_error.maximum"), 0.2, 6e-7);
}

// Everything moves by d in a substep h: v = d / h, E = m v^2 / 2, p = m v, and the energy of weight
// is -m g . d. The mass of a hair of length L is its line density times L.
TEST_F(GuideProbes, GiveTheEnergyAndMomentumOfATranslation) {
    SimulationSettings settings = still();
    settings.gravity = {1.0f, -9.0f, 2.0f};
    const groom::Groom groom = straightGroom(3, 8, 0.03);
    const glm::vec3 moved{0.25f, -0.125f, 0.5f};
    std::vector<glm::vec3> points = groom.points;
    for (glm::vec3& point : points) point += moved;
    const Frame frame = probedAt(groom, settings, points, groom.points);
    const double mass = 3.0 * kLineDensity * 7.0 * 0.03;  // kg
    const glm::dvec3 velocity = glm::dvec3(moved) / kProbedStep;
    const double kinetic = 0.5 * mass * glm::dot(velocity, velocity);
    EXPECT_NEAR(frame.at("kinetic_energy"), kinetic, kRounding * kinetic);
    const double weight = -mass * glm::dot(glm::dvec3(1.0, -9.0, 2.0), glm::dvec3(moved));
    EXPECT_NEAR(frame.at("gravitational_energy"), weight, kRounding * std::abs(weight));
    const char* const names[] = {"momentum.x", "momentum.y", "momentum.z"};
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(
            frame.at(names[i]), mass * velocity[i], kRounding * mass * glm::length(velocity));
    EXPECT_NEAR(frame.at("speed"), glm::length(velocity), kRounding * glm::length(velocity));
}

// The head turns a straight hair round its root by w = 90 degrees/s. Masses at n + 1 vertices have
// the moment of inertia m L^2 (1/3 + 1/(6 n^2)), and a vertex goes along the chord, by 2 r sin(w h
// / 2) in a substep h. The head carries the tip, so that it is not displaced.
TEST_F(GuideProbes, GiveTheEnergyOfARigidRotation) {
    SimulationSettings settings = still();
    settings.solver = Solver::none;
    settings.motion = {
        .keyframes =
            {{.time = 0.0f},
             {.time = 1.0f, .rotation = {0.0f, 90.0f, 0.0f}},
             {.time = 2.0f, .rotation = {0.0f, 180.0f, 0.0f}}},
        .repeat = true};
    constexpr int kSegments = 10;
    constexpr double kLength = 0.25;  // m
    const groom::Groom groom = oneGuide(straightRod(kSegments, kLength));
    Simulation simulation(device(), groom, settings, 1);
    advance(device(), simulation, 20);
    const Frame frame = probed(simulation, groom, settings);
    const double rate = 2.0 * std::sin(kPi / 2.0 * kProbedStep / 2.0) / kProbedStep;  // 1/s
    const double inertia =
        kLineDensity * std::pow(kLength, 3.0) * (1.0 / 3.0 + 1.0 / (6.0 * kSegments * kSegments));
    // A vertex moves by 6 mm in the step; both ends are rounded by 1.5e-8 m.
    constexpr double kOfSpeeds = 1e-5;
    const double kinetic = 0.5 * inertia * rate * rate;
    EXPECT_NEAR(frame.at("kinetic_energy"), kinetic, kOfSpeeds * kinetic);
    EXPECT_NEAR(frame.at("speed"), rate * kLength, kOfSpeeds * rate * kLength);
    EXPECT_NEAR(frame.at("tip_displacement.maximum"), 0.0, 6e-8);
    EXPECT_NEAR(frame.at("groom_distance.maximum"), 0.0, 6e-8);
    EXPECT_NEAR(frame.at("length_error.maximum"), 0.0, 2e-6);  // of 25 mm
    // Half of the step before and the turn so far: the centre of mass moves across the hair.
    const double turn = kPi / 2.0 * 19.5 * kProbedStep;
    const double momentum = kLineDensity * kLength * kLength / 2.0 * rate;
    EXPECT_NEAR(frame.at("momentum.x"), -momentum * std::sin(turn), kOfSpeeds * momentum);
    EXPECT_NEAR(frame.at("momentum.z"), -momentum * std::cos(turn), kOfSpeeds * momentum);
}

// A hair of ten segments of 0.1 m hangs through a capsule of radius 0.25 m round a level axis at
// 0.5 m. Its vertices at 0.3 to 0.7 m are inside, the one at 0.5 m on the axis. With a margin of
// 0.06 m those at 0.2 and 0.8 m touch, too.
TEST_F(GuideProbes, CountKnownContactsWithACapsule) {
    SimulationSettings settings = still();
    settings.colliders = {{.a = {-1.0f, -0.5f, 0.0f}, .b = {1.0f, -0.5f, 0.0f}, .radius = 0.25f}};
    const groom::Groom groom = straightGroom(2, 11, 0.1);
    Frame frame = probedAt(groom, settings, groom.points, groom.points);
    EXPECT_EQ(frame.at("contacts"), 2.0 * 5.0);
    EXPECT_NEAR(frame.at("penetration"), 0.25, 1e-7);
    settings.collision.margin = 0.06f;
    frame = probedAt(groom, settings, groom.points, groom.points);
    EXPECT_EQ(frame.at("contacts"), 2.0 * 7.0);
    EXPECT_NEAR(frame.at("penetration"), 0.25, 1e-7);
}

// Roots belong to the head, even inside its capsule, and a capsule goes where the head is.
TEST_F(GuideProbes, CountContactsWhereTheHeadIs) {
    SimulationSettings settings = still();
    settings.motion.keyframes = {{.time = 0.0f, .translation = {0.0f, 1.0f, 0.0f}}};
    settings.colliders = {{.a = {0.0f, 0.0f, 0.0f}, .b = {0.0f, 0.0f, 0.0f}, .radius = 0.15f}};
    const groom::Groom groom = straightGroom(1, 4, 0.1);
    Frame frame = probed(Simulation(device(), groom, settings, 1), groom, settings);
    EXPECT_EQ(frame.at("contacts"), 1.0);  // at 0.1 m
    EXPECT_NEAR(frame.at("penetration"), 0.05, 2e-7);
    settings.colliders[0].follows = Follows::world;
    frame = probed(Simulation(device(), groom, settings, 1), groom, settings);
    EXPECT_EQ(frame.at("contacts"), 0.0);
    EXPECT_EQ(frame.at("penetration"), 0.0);
}

// An arc of n segments that turns by an angle has n - 1 bends of angle / n each, and no torsion.
// The angle's series is off by 1e-5 rad at most, at half a turn.
TEST_F(GuideProbes, GiveTheBendsOfAnArc) {
    for (const double turn : {0.5, 2.0, 9.0}) {
        constexpr int kSegments = 12;
        const groom::Groom groom = oneGuide(arc(kSegments, 0.2, turn));
        const Frame frame = probed(Simulation(device(), groom, still(), 1), groom, still());
        const double bend = turn / kSegments * 180.0 / kPi;
        // Directions of segments of 17 mm between positions that are rounded by up to 1.5e-8 m.
        EXPECT_NEAR(frame.at("bending.mean"), bend, 1e-4) << turn;
        EXPECT_NEAR(frame.at("bending.maximum"), bend, 2e-4) << turn;
        EXPECT_NEAR(frame.at("torsion.maximum"), 0.0, 2e-3) << turn;
    }
}

// A zigzag in a plane turns over at each vertex: its bends are whole, and each plane is opposite to
// the one before.
TEST_F(GuideProbes, GiveTheTorsionOfAZigzag) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 9; ++i) points.emplace_back(0.01 * i, i % 2 == 0 ? 0.0 : 0.01, 0.0);
    const groom::Groom groom = oneGuide(points);
    const Frame frame = probed(Simulation(device(), groom, still(), 1), groom, still());
    constexpr double kSeries = 1e-5 * 180.0 / kPi;
    EXPECT_NEAR(frame.at("bending.mean"), 90.0, 1e-4);
    EXPECT_NEAR(frame.at("torsion.mean"), 180.0, kSeries + 1e-4);
    EXPECT_NEAR(frame.at("torsion.maximum"), 180.0, kSeries + 1e-4);
}

// Vertices of a helix are a turn by p apart round its axis, and so are successive edges (c, h) and
// planes: with c across and h along the axis, the normal of two edges has the parts 2 c h sin(p /
// 2) across and c^2 sin p along it, and two vectors that a turn by p takes into each other are as
// far apart as their parts across the axis turn.
TEST_F(GuideProbes, GiveTheBendsAndTorsionOfAHelix) {
    constexpr double kRadius = 0.01, kPitch = 0.03, kTurns = 2.0;
    constexpr int kSegments = 24;
    const double p = 2.0 * kPi * kTurns / kSegments;
    const double c = 2.0 * kRadius * std::sin(p / 2.0), h = kPitch * kTurns / kSegments;
    const double across = 2.0 * c * h * std::sin(p / 2.0), along = c * c * std::sin(p);
    const double bend = 2.0 * std::asin(std::sin(p / 2.0) * c / std::hypot(c, h)) * 180.0 / kPi;
    const double torsion =
        2.0 * std::asin(std::sin(p / 2.0) * across / std::hypot(across, along)) * 180.0 / kPi;
    const groom::Groom groom = oneGuide(helix(kSegments, kRadius, kPitch, kTurns));
    const Frame frame = probed(Simulation(device(), groom, still(), 1), groom, still());
    // Directions of segments of 6 mm between positions that are rounded by 4e-9 m.
    EXPECT_NEAR(frame.at("bending.mean"), bend, 1e-4);
    EXPECT_NEAR(frame.at("bending.maximum"), bend, 3e-4);
    EXPECT_NEAR(frame.at("torsion.mean"), torsion, 2e-4);
    EXPECT_NEAR(frame.at("torsion.maximum"), torsion, 6e-4);
}

// Many guides, in no order: sums lose nothing that their number explains, quantiles are exact, and
// a second time every bit is the same. Tips are moved by multiples of 2^-10 m along an axis from 0,
// which are exact.
TEST_F(GuideProbes, CombineManyGuidesExactly) {
    constexpr std::uint32_t kGuides = 70001;
    groom::Groom groom{.strand_count = kGuides, .vertices_per_strand = 2};
    for (std::uint32_t s = 0; s < kGuides; ++s) {
        groom.points.emplace_back(0.0f, 0.125f, 0.0f);
        groom.points.emplace_back(0.0f, 0.0f, 0.0f);
    }
    std::vector<glm::vec3> points = groom.points;
    std::mt19937 random(3);
    std::vector<double> moved;
    double sum = 0.0;
    for (std::uint32_t s = 0; s < kGuides; ++s) {
        moved.push_back(static_cast<double>(random() % 4096) / 1024.0);
        points[2 * s + 1].x = static_cast<float>(moved.back());
        sum += moved.back();
    }
    Simulation simulation(device(), groom, still(), 1);
    simulation.setState(points, points);
    const Frame frame = probed(simulation, groom, still());
    EXPECT_NEAR(frame.at("tip_displacement.mean"), sum / kGuides, 1e-7 * sum / kGuides);
    std::ranges::sort(moved);
    EXPECT_EQ(frame.at("tip_displacement.median"), moved[kGuides / 2]);
    EXPECT_EQ(
        frame.at("tip_displacement.percentile_90"),
        moved[static_cast<std::size_t>(std::ceil(0.9 * kGuides)) - 1]);
    EXPECT_EQ(frame.at("tip_displacement.maximum"), moved.back());
    EXPECT_EQ(probed(simulation, groom, still()), frame);
}

// A rod that is straight at rest and bent into an arc: n segments of length l turn by b at each of
// n - 1 joints, and the first stands at b / 2 from the follicle. Bobenko and Suris 1999: a joint
// has the energy -4 K ln cos(b / 2) with K = E I / l. Half a joint and its mirror image, with 2 K,
// make -2 K ln cos(b / 2) at the follicle. For small bends the sum is E I k^2 L / 2 of an arc of
// curvature k.
TEST_F(GuideProbes, GiveTheElasticEnergyOfABentRod) {
    SimulationSettings settings = still();
    settings.solver = Solver::rod;
    settings.substeps = 1;
    constexpr int kSegments = 20;
    constexpr double kLength = 0.2;  // m
    const groom::Groom groom = oneGuide(straightRod(kSegments, kLength));
    const double stiffness = bendingStiffness({}) / (kLength / kSegments);  // N m
    for (const double turn : {0.6, 12.0}) {
        const groom::Groom bent = oneGuide(arc(kSegments, kLength, turn));
        const Frame frame = probedAt(groom, settings, bent.points, bent.points);
        const double bend = turn / kSegments;
        const double joint = -4.0 * stiffness * std::log(std::cos(bend / 2.0));
        const double expected = (kSegments - 1 + 0.5) * joint;
        // At the small bend, 0.03 rad, directions of segments of 1 cm are off by 2e-6 rad.
        EXPECT_NEAR(frame.at("elastic_energy"), expected, 3e-4 * expected) << turn;
        if (turn > 1.0) continue;
        const double continuum =
            bendingStiffness({}) * std::pow(turn / kLength, 2.0) * kLength / 2.0;
        // Half of a bend at the tip does not exist: 1 / (2 n). cos adds b^2 / 24.
        EXPECT_NEAR(frame.at("elastic_energy"), continuum, 0.026 * continuum);
    }
}

// A rod that takes a set is held on an arc: the energy of the share that yields falls as
// exp(-2 t / tau), t from the middle of the substep before the first to the end of the last.
// Squares of h / tau are left out, 1e-3 / 12.
TEST_F(GuideProbes, GiveTheElasticEnergyOfARodThatYields) {
    SimulationSettings settings = still();
    settings.solver = Solver::rod;
    settings.substeps = 1;
    const groom::Groom groom = oneGuide(straightRod(20, 0.2));
    const groom::Groom bent = oneGuide(arc(20, 0.2, 0.6));
    const double whole = probedAt(groom, settings, bent.points, bent.points).at("elastic_energy");
    settings.material.set_share = 0.7f;
    settings.material.set_time = 0.5f;
    Simulation simulation(device(), groom, settings, 1);
    for (int steps = 0; steps <= 40; ++steps) {
        simulation.setState(bent.points, bent.points);
        const double time = (steps + 0.5) * double{settings.time_step};
        EXPECT_NEAR(
            probed(simulation, groom, settings).at("elastic_energy") / whole,
            0.3 + 0.7 * std::exp(-2.0 * time / 0.5), 1e-3)
            << steps;
        advance(device(), simulation, 1);
    }
}

// A hair is let go level and swings. Without friction its energy stays what it was, 0, since it
// begins at rest: kinetic and elastic energy come from gravity. The error is that of the step.
// Generalised alpha keeps energy to second order; a velocity over a substep h is that half of it
// earlier, which an acceleration of g changes by g h / 2, and the hair gets as fast as sqrt(g L).
TEST_F(GuideProbes, KeepTheEnergyOfASwingingHair) {
    SimulationSettings settings = still();
    settings.solver = Solver::rod;
    settings.rod = {.iterations = 8, .integrator = RodIntegrator::generalized_alpha};
    settings.gravity = {0.0f, static_cast<float>(-kEarth), 0.0f};
    settings.substeps = 32;
    constexpr double kLength = 0.1;  // m
    const groom::Groom groom = oneGuide(straightRod(16, kLength));
    Simulation simulation(device(), groom, settings, 1);
    const double scale = kLineDensity * kLength * kEarth * kLength / 2.0;  // J, of a whole fall
    double most_kinetic = 0.0;
    for (int step = 0; step < 24; ++step) {
        advance(device(), simulation, 1);
        const Frame frame = probed(simulation, groom, settings);
        const double sum = frame.at("kinetic_energy") + frame.at("gravitational_energy") +
                           frame.at("elastic_energy");
        EXPECT_NEAR(sum / scale, 0.0, 0.02) << step;
        most_kinetic = std::max(most_kinetic, frame.at("kinetic_energy"));
    }
    EXPECT_GT(most_kinetic / scale, 0.1);  // it has moved
}

// Computing probes leaves positions as they are, bit by bit.
TEST_F(GuideProbes, LeaveTheStateAlone) {
    SimulationSettings settings = still();
    settings.gravity = {0.0f, -9.8f, 0.0f};
    for (const Solver solver : kSolvers) {
        settings.solver = solver;
        const groom::Groom groom = wavyGroom(5, 8);
        Simulation with(device(), groom, settings, 1), without(device(), groom, settings, 1);
        for (int step = 0; step < 5; ++step) {
            probed(with, groom, settings);
            advance(device(), with, 1);
            advance(device(), without, 1);
        }
        EXPECT_EQ(with.readPositions(), without.readPositions());
    }
}

}  // namespace
}  // namespace hair::simulation
