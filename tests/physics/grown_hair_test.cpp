// Hair as users have it: the grown grooms with bodies, after settling and one second later.
#include <filesystem>

#include "benchmarks/scene/assets.h"
#include "benchmarks/scene/scene.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/simulation/gpu_simulation.h"

namespace benchmarks::physics {
namespace {

// The greatest ratio of a guide's length to its rest length.
double greatestLength(const hair::groom::Groom& groom, std::span<const glm::vec3> points) {
    Extremes ratios;
    for (std::uint32_t strand = 0; strand < groom.strand_count; ++strand) {
        const auto rest = groom.strand(strand);
        const auto now =
            points.subspan(std::size_t{strand} * groom.vertices_per_strand, rest.size());
        double length = 0.0;
        double rest_length = 0.0;
        for (std::size_t i = 1; i < rest.size(); ++i) {
            length += glm::distance(glm::dvec3(now[i]), glm::dvec3(now[i - 1]));
            rest_length += glm::distance(glm::dvec3(rest[i]), glm::dvec3(rest[i - 1]));
        }
        ratios.add(length / rest_length);
    }
    return ratios.greatest();
}

namespace fs = std::filesystem;

using GrownHair = GpuTest;

// The greatest distance of a tip from its place in the groom, relative to its guide's length.
double tipsMoved(const hair::groom::Groom& groom, std::span<const glm::vec3> points) {
    Extremes moved;
    for (std::uint32_t strand = 0; strand < groom.strand_count; ++strand) {
        const auto rest = groom.strand(strand);
        const std::size_t tip = (std::size_t{strand} + 1) * groom.vertices_per_strand - 1;
        double length = 0.0;
        for (std::size_t i = 1; i < rest.size(); ++i)
            length += glm::distance(glm::dvec3(rest[i]), glm::dvec3(rest[i - 1]));
        moved.add(glm::distance(glm::dvec3(points[tip]), glm::dvec3(rest.back())) / length);
    }
    return moved.greatest();
}

// The requirement after 10 s is 0.1 % of the length with `rod` and 1 % with `shape`. A tenth of the
// latter after the first second leaves room for nine more.
TEST_F(GrownHair, HangsAsItIsGroomedAndKeepsItsLength) {
    for (const char* name : {"short_straight", "long_straight", "wavy_bob", "tight_curls"}) {
        const fs::path path =
            fs::path(HAIRBENCH_SCENES_DIR) / "root_triangles" / (std::string(name) + ".json");
        hair::Settings settings = scene::loadScene(path).settings;
        scene::AssetStore assets;
        const hair::groom::Groom& groom = assets.groom(settings, path.parent_path());
        const auto fields = scene::loadFieldMeshes(
            settings, assets.mesh(settings, path.parent_path()), path.parent_path());
        ASSERT_FALSE(fields.empty()) << name;
        for (const hair::Solver solver : {hair::Solver::shape, hair::Solver::rod}) {
            settings.simulation.solver = solver;
            hair::simulation::Simulation simulation(
                device(), groom, settings.simulation, settings.seed, fields);
            EXPECT_EQ(simulation.condition().depth.guides, 0u) << name;
            ASSERT_NE(simulation.balance(), nullptr) << name;
            EXPECT_TRUE(simulation.balance()->unbalanced.empty()) << name;
            hair::simulation::advance(device(), simulation, 60);
            const auto points = simulation.readPositions();
            const bool rod = solver == hair::Solver::rod;
            EXPECT_LE(tipsMoved(groom, points), 1e-4) << name << ' ' << rod;
            EXPECT_EQ(simulation.condition().speed.guides, 0u) << name << ' ' << rod;
            EXPECT_LE(greatestLength(groom, points), 1.01) << name << ' ' << rod;
        }
    }
}

// Wind moves the hair, and it still keeps its length.
TEST_F(GrownHair, KeepsItsLengthInWind) {
    const fs::path path = fs::path(HAIRBENCH_SCENES_DIR) / "root_triangles/wavy_bob.json";
    hair::Settings settings = scene::loadScene(path).settings;
    settings.simulation.wind.strength = 15.0f;
    scene::AssetStore assets;
    const hair::groom::Groom& groom = assets.groom(settings, path.parent_path());
    const auto fields = scene::loadFieldMeshes(
        settings, assets.mesh(settings, path.parent_path()), path.parent_path());
    hair::simulation::Simulation simulation(
        device(), groom, settings.simulation, settings.seed, fields);
    hair::simulation::advance(device(), simulation, 60);
    EXPECT_LE(greatestLength(groom, simulation.readPositions()), 1.01);
    EXPECT_GT(tipsMoved(groom, simulation.readPositions()), 0.01);
}

}  // namespace
}  // namespace benchmarks::physics
