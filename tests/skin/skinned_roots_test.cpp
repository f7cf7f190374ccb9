#include <cmath>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "engine/error.h"
#include "hair/groom/mesh/deforming_mesh.h"
#include "hair/groom/mesh/import_mesh.h"
#include "hair/simulation/simulation.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/simulation/gpu_simulation.h"
#include "tests/simulation/motions.h"
#include "tests/simulation/strands.h"
#include "tests/skin/animated_gltf.h"
#include "tests/skin/bending_sheet.h"

namespace hair::simulation {
namespace {

using GpuSkin = GpuTest;

groom::DeformingMesh
deforming(const std::filesystem::path& path, const AnimationSettings& settings) {
    return {groom::importMesh(path), groom::MeshAnimation(path, settings.clip), settings};
}

// Returns settings for every solver, including `none`.
std::vector<SimulationSettings> everySolver() {
    std::vector<SimulationSettings> all(1);
    all.back().solver = Solver::none;
    for (const Solver solver : kSolvers) all.emplace_back().solver = solver;
    return all;
}

// Returns settings for every solver, and for every parallelism of `shape`.
std::vector<SimulationSettings> everyShader() {
    std::vector<SimulationSettings> all = everySolver();
    for (const Parallelism parallelism :
         {Parallelism::vertex, Parallelism::strand, Parallelism::serial})
        all.emplace_back().parallelism = parallelism;
    for (const Parallelism parallelism : {Parallelism::automatic, Parallelism::serial}) {
        all.emplace_back().parallelism = parallelism;
        all.back().local.method = LocalMethod::energy;
    }
    return all;
}

std::string nameOf(const SimulationSettings& settings) {
    return "solver " + std::to_string(static_cast<int>(settings.solver)) + ", parallelism " +
           std::to_string(static_cast<int>(settings.parallelism)) + ", local method " +
           std::to_string(static_cast<int>(settings.local.method));
}

double lengthOf(const groom::Groom& groom, std::span<const glm::vec3> points, std::uint32_t s) {
    double length = 0.0;
    const std::size_t first = std::size_t{s} * groom.vertices_per_strand;
    for (std::size_t i = first + 1; i < first + groom.vertices_per_strand; ++i)
        length += glm::distance(glm::dvec3(points[i]), glm::dvec3(points[i - 1]));
    return length;
}

// bending_sheet.h computes each root's triangle and its moving corners independently of the code
// under test. The documentation promises a micrometre; floats of 0.2 m round by 0.01 micrometres.
TEST_F(GpuSkin, KeepsRootsOnTheirTriangles) {
    const TemporaryFolder folder;
    const auto path = BendingSheet::write(folder);
    const groom::Groom groom = BendingSheet::groom();
    const std::vector<BendingSheet::Place> places = BendingSheet::places();
    const AnimationSettings animation{.clip = "play", .repeat = false};
    const groom::DeformingMesh mesh = deforming(path, animation);
    for (SimulationSettings settings : everyShader()) {
        SCOPED_TRACE(nameOf(settings));
        settings.animation = animation;
        Simulation simulation(device(), groom, settings, 1, {}, {}, &mesh);
        ASSERT_TRUE(simulation.moves());
        for (const int steps : {0, 1, 5, 6, 14}) {  // to 0.43 s: past the end of the clip
            advance(device(), simulation, steps);
            const std::vector<glm::vec3> points = simulation.readPositions();
            for (std::size_t s = 0; s < places.size(); ++s) {
                const glm::dvec3 root(points[s * groom.vertices_per_strand]);
                EXPECT_LT(glm::distance(root, places[s].at(simulation.time())), 1e-6)
                    << "strand " << s << " at " << simulation.time() << " s";
            }
        }
        // No strand is torn: it gets longer by less than a tenth, even with the softest solvers,
        // `shape` with its iterations and springs.
        const std::vector<glm::vec3> points = simulation.readPositions();
        for (std::uint32_t s = 0; s < groom.strand_count; ++s)
            EXPECT_LT(lengthOf(groom, points, s), 1.1 * lengthOf(groom, groom.points, s))
                << "strand " << s;
    }
}

// Frozen hair keeps its shape relative to its triangle, which turns by up to 60 degrees about z.
TEST_F(GpuSkin, TurnsFrozenHairWithItsTriangle) {
    const TemporaryFolder folder;
    const auto path = BendingSheet::write(folder);
    const groom::Groom groom = BendingSheet::groom();
    const std::vector<BendingSheet::Place> places = BendingSheet::places();
    SimulationSettings settings;
    settings.solver = Solver::none;
    settings.animation = {.clip = "play", .repeat = false};
    const groom::DeformingMesh mesh = deforming(path, settings.animation);
    Simulation simulation(device(), groom, settings, 1, {}, {}, &mesh);
    advance(device(), simulation, 30);
    const std::vector<glm::vec3> points = simulation.readPositions();
    for (std::uint32_t s = 0; s < groom.strand_count; ++s) {
        const auto corner = [&](int along, int across) {
            return BendingSheet::vertexAt(
                places[s].along + along, places[s].across + across, BendingSheet::kTime);
        };
        // The sheet's squares stay rectangles. Only their axes along the sheet turn; those across
        // it don't.
        const glm::dvec3 along = glm::normalize(corner(1, 0) - corner(0, 0));
        const glm::dquat turn = glm::angleAxis(std::atan2(along.y, along.x), glm::dvec3(0, 0, 1));
        const std::size_t first = std::size_t{s} * groom.vertices_per_strand;
        for (std::uint32_t v = 0; v < groom.vertices_per_strand; ++v) {
            const glm::dvec3 rest = glm::dvec3(groom.points[first + v] - groom.points[first]);
            EXPECT_LT(
                glm::distance(
                    glm::dvec3(points[first + v]), places[s].at(BendingSheet::kTime) + turn * rest),
                1e-6);
        }
    }
}

// ---- A mesh that moves as a whole ---------------------------------------------------------------

constexpr int kSteps = 24;

// Writes a triangle under all of the hair. Its node has a keyframe at every substep, with the pose
// of `motion`.
std::filesystem::path
writeRigid(const TemporaryFolder& folder, const MotionSettings& motion, double substep, int count) {
    AnimatedGltf file;
    file.primitive = R"("attributes":{"POSITION":)" +
                     std::to_string(file.vectors({{-1, 0, -1}, {0, 0, 1}, {1, 0, -1}})) + "}";
    file.nodes = R"({"mesh":0})";
    const HeadMotion head(motion);
    std::vector<float> times;
    std::vector<glm::vec3> translations;
    std::vector<glm::vec4> rotations;
    for (int i = 0; i <= count; ++i) {
        times.push_back(static_cast<float>(substep * i));
        const RigidMotion pose = head.at(double{times.back()});
        translations.emplace_back(pose.translation);
        rotations.emplace_back(pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w);
    }
    const std::string input = std::to_string(file.scalars(times));
    const std::string first = std::to_string(file.vectors(translations));
    const std::string second = std::to_string(file.rotations(rotations));
    file.animations =
        R"({"name":"play","channels":[{"sampler":0,"target":{"node":0,"path":"translation"}},)"
        R"({"sampler":1,"target":{"node":0,"path":"rotation"}}],"samplers":[{"input":)" +
        input + R"(,"output":)" + first + R"(},{"input":)" + input + R"(,"output":)" + second +
        "}]}";
    return file.write(folder);
}

// The file rounds poses to floats: 6e-8 of 0.3 m. Stiff hair, and hair that slides on bodies,
// passes these errors on to velocities. So strands of 0.2 m may differ by 0.1 mm after 24 steps. If
// the head's pose came a substep too early or late, they would be off by 10 mm.
TEST_F(GpuSkin, MovesHairAsTheSameRigidMotionDoes) {
    const MotionSettings motion{
        .keyframes =
            {{.time = 0.0f, .rotation = {-30, 0, 0}},
             {.time = 0.2f, .rotation = {30, 20, 5}, .translation = {0.05f, 0, 0}},
             {.time = 0.4f, .rotation = {-30, 0, 0}}},
        .pivot = kNeck};
    const groom::Groom groom = wavyGroom(9, 8);
    for (SimulationSettings settings : everySolver()) {
        SCOPED_TRACE(nameOf(settings));
        settings.collision = {.margin = 0.002f, .friction = 0.3f};
        settings.colliders = {{.a = {0, 0, 0}, .b = {0, 0.05f, 0}, .radius = 0.06f}};
        const gpu::Step step = stepOf(settings);
        const TemporaryFolder folder;
        const double substep = double{settings.time_step} / step.count;
        const auto path =
            writeRigid(folder, motion, substep, kSteps * static_cast<int>(step.count));
        SimulationSettings animated = settings;
        animated.animation = {.clip = "play", .repeat = false};
        settings.motion = motion;
        const groom::DeformingMesh mesh = deforming(path, animated.animation);
        Simulation by_clip(device(), groom, animated, 1, {}, {}, &mesh);
        Simulation by_motion(device(), groom, settings, 1);
        for (int i = 0; i < kSteps; ++i) {
            advance(device(), by_clip, 1);
            advance(device(), by_motion, 1);
            const glm::dvec3 point{0.1, 0.1, 0.1};
            EXPECT_LT(glm::distance(by_clip.pose()(point), by_motion.pose()(point)), 1e-6);
        }
        EXPECT_LT(largestDifference(by_clip.readPositions(), by_motion.readPositions()), 1e-4);
    }
}

// Applies the clip first, then the motion, to a root in the plane of the sheet's hinge.
TEST_F(GpuSkin, ComposesWithTheHeadsMotion) {
    const TemporaryFolder folder;
    const auto path = BendingSheet::write(folder);
    const groom::Groom groom = BendingSheet::groom();
    const std::vector<BendingSheet::Place> places = BendingSheet::places();
    SimulationSettings settings;
    settings.animation = {.clip = "play", .repeat = false};
    settings.motion = nodding();
    const groom::DeformingMesh mesh = deforming(path, settings.animation);
    Simulation simulation(device(), groom, settings, 1, {}, {}, &mesh);
    advance(device(), simulation, 7);
    const RigidMotion head = HeadMotion(settings.motion).at(simulation.time());
    const std::vector<glm::vec3> points = simulation.readPositions();
    for (std::size_t s = 0; s < places.size(); ++s)
        EXPECT_LT(
            glm::distance(
                glm::dvec3(points[s * groom.vertices_per_strand]),
                head(places[s].at(simulation.time()))),
            1e-6);
}

// ---- A mesh that stands still -------------------------------------------------------------------

// Returns the kinetic and potential energy of vertices with unit masses, J / kg.
double energyOf(const Simulation& simulation, const SimulationSettings& settings) {
    const auto now = simulation.readPositions();
    const auto before = simulation.readPrevious();
    const double substep = stepOf(settings).sub;
    double energy = 0.0;
    for (std::size_t i = 0; i < now.size(); ++i) {
        const glm::dvec3 velocity = (glm::dvec3(now[i]) - glm::dvec3(before[i])) / substep;
        energy += 0.5 * glm::dot(velocity, velocity) -
                  glm::dot(glm::dvec3(settings.gravity), glm::dvec3(now[i]));
    }
    return energy;
}

// A clip that does not move the mesh leaves the energy of falling hair unchanged, except for the
// rounding of frames (1e-7 of it), which grows over 30 steps.
TEST_F(GpuSkin, GivesNoEnergyWhereTheMeshStandsStill) {
    const TemporaryFolder folder;
    const auto path = BendingSheet::write(folder);
    const groom::Groom groom = BendingSheet::groom();
    for (SimulationSettings settings : everySolver()) {
        SCOPED_TRACE(nameOf(settings));
        SimulationSettings animated = settings;
        animated.animation.clip = "still";
        const groom::DeformingMesh mesh = deforming(path, animated.animation);
        Simulation with(device(), groom, animated, 1, {}, {}, &mesh);
        Simulation without(device(), groom, settings, 1);
        advance(device(), with, 30);
        advance(device(), without, 30);
        const double expected = energyOf(without, settings);
        EXPECT_NEAR(energyOf(with, settings), expected, 1e-5 * std::abs(expected));
        EXPECT_LT(largestDifference(with.readPositions(), without.readPositions()), 1e-5);
    }
}

TEST_F(GpuSkin, GivesTheSameBitsAgainAfterReset) {
    const TemporaryFolder folder;
    const auto path = BendingSheet::write(folder);
    const groom::Groom groom = BendingSheet::groom();
    for (const Solver solver : {Solver::shape, Solver::rod}) {
        SimulationSettings settings;
        settings.solver = solver;
        settings.settle_steps = 5;
        settings.animation.clip = "play";
        const groom::DeformingMesh mesh = deforming(path, settings.animation);
        Simulation simulation(device(), groom, settings, 1, {}, {}, &mesh);
        const auto start = simulation.readPositions();
        advance(device(), simulation, 20);
        const auto end = simulation.readPositions();
        EXPECT_NE(start, end);
        simulation.reset();
        EXPECT_EQ(simulation.readPositions(), start);
        advance(device(), simulation, 20);
        EXPECT_EQ(simulation.readPositions(), end);
    }
}

TEST_F(GpuSkin, NeedsAMeshForAClip) {
    SimulationSettings settings;
    settings.animation.clip = "play";
    EXPECT_THROW(Simulation(device(), BendingSheet::groom(), settings, 1), engine::Error);
}

}  // namespace
}  // namespace hair::simulation
