// Hair as users have it: the grown grooms, among bodies, after it settled and for a second after.
#include <filesystem>

#include "benchmarks/scene/assets.h"
#include "benchmarks/scene/scene.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/simulation/gpu_simulation.h"

namespace benchmarks::physics {
namespace {

// The greatest length of a guide, over its length at rest.
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

TEST_F(GrownHair, KeepsItsLength) {
    for (const char* name : {"short_straight", "long_straight", "wavy_bob", "tight_curls"}) {
        const fs::path path = fs::path(HAIRBENCH_SCENES_DIR) / (std::string(name) + ".json");
        const hair::Settings settings = scene::loadScene(path).settings;
        scene::AssetStore assets;
        const hair::groom::Groom& groom = assets.groom(settings, path.parent_path());
        hair::simulation::Simulation simulation(
            device(), groom, settings.simulation, settings.seed);
        EXPECT_LE(greatestLength(groom, simulation.readPositions()), 1.01) << name << ", settled";
        hair::simulation::advance(device(), simulation, 60);
        EXPECT_LE(greatestLength(groom, simulation.readPositions()), 1.01) << name << ", 1 s";
    }
}

}  // namespace
}  // namespace benchmarks::physics
