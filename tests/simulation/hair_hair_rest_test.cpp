#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "benchmarks/scene/scene.h"
#include "hair/groom/build_groom.h"
#include "hair/groom/mesh/import_mesh.h"
#include "hair/simulation/hair_hair.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/simulation/gpu_simulation.h"
#include "tests/simulation/strands.h"

// Tests that hair without disturbance comes to rest with hair-hair contact, and stays there.
namespace hair::simulation {
namespace {

constexpr int kWindow = 5 * 60;   // steps
constexpr int kSteps = 60 * 60;   // steps, at most
constexpr int kLast = 10 * 60;    // steps in which nothing may move

struct RestCase {
    std::string name;
    Solver solver;
    HairHairSettings hair_hair;
};

void PrintTo(const RestCase& rest_case, std::ostream* out) { *out << rest_case.name; }

class HairOnHairRest : public GpuTest, public testing::WithParamInterface<RestCase> {};

// The thesis's head and hair. The hair falls from its combed state onto ten capsules with friction.
TEST_P(HairOnHairRest, EndsInRest) {
    const std::string scenes = HAIRBENCH_SCENES_DIR;
    Settings settings = benchmarks::scene::loadScene(scenes + "/thesis.json").settings;
    const groom::Mesh head = groom::importMesh(scenes + "/" + settings.groom.grow.mesh);
    const groom::Groom groom = groom::buildGroom(settings.groom, &head, scenes, settings.seed);
    ASSERT_EQ(groom.strand_count, 86u);
    settings.simulation.settle_steps = 0;
    settings.simulation.solver = GetParam().solver;
    settings.simulation.hair_hair = GetParam().hair_hair;
    ASSERT_FALSE(settings.simulation.colliders.empty());

    Simulation simulation(device(), groom, settings.simulation, settings.seed);
    const auto shares = lengthShares(groom);
    std::vector<Extremes> windows;  // energies in each window, m^2/s^2
    auto before = simulation.readPositions();
    std::vector<glm::vec3> low;
    std::vector<glm::vec3> high;
    // Positions of 0.25 m are rounded to 1.5e-8 m, some ten times in a step: 3e-6 m/s at 60 Hz. The
    // solver may spread that by a factor of three.
    constexpr double kFloor = 0.5 * 1e-5 * 1e-5;
    int last = kSteps - kLast;  // begins once a whole window is at rest
    for (int step = 0; step < last + kLast; ++step) {
        advance(device(), simulation, 1);
        const auto now = simulation.readPositions();
        double energy = 0.0;
        for (std::size_t i = 0; i < now.size(); ++i) {
            const glm::dvec3 velocity = 60.0 * (glm::dvec3(now[i]) - glm::dvec3(before[i]));
            energy += 0.5 * shares[i] * glm::dot(velocity, velocity);
        }
        ASSERT_TRUE(std::isfinite(energy)) << "step " << step;
        if (step % kWindow == 0) {
            const bool rests = !windows.empty() && windows.back().greatest() < kFloor;
            if (rests) last = std::min(last, step);
            windows.emplace_back();
        }
        windows.back().add(energy);
        if (step == last) low = high = now;
        for (std::size_t i = 0; i < low.size(); ++i) {
            low[i] = glm::min(low[i], now[i]);
            high[i] = glm::max(high[i], now[i]);
        }
        before = now;
    }

    std::vector<double> energies;  // the greatest of each window, m^2/s^2
    for (const Extremes& window : windows) energies.push_back(window.greatest());
    EXPECT_GT(energies[0], 1e-2);  // it did fall
    for (std::size_t i = 1; i < energies.size(); ++i)
        EXPECT_TRUE(energies[i] < energies[i - 1] || energies[i] < kFloor)
            << energies[i - 1] << " then " << energies[i] << " in window " << i;
    EXPECT_LT(energies.back(), kFloor);
    EXPECT_LT(largestDifference(low, high), 1e-4 * longestStrand(groom));
}

// Loose hair, hair that moves together, and hair under pressure everywhere with almost no friction.
// With a force without a potential (hair_hair.h), the last moved in circles.
constexpr HairHairSettings kLoose{.friction = 0.3f, .repulsion = 0.3f, .crowding = 1.0f};
constexpr HairHairSettings kTight{.friction = 1.0f, .repulsion = 1.5f, .crowding = 1.0f};
constexpr HairHairSettings kCrowded{.friction = 0.05f, .repulsion = 0.6f, .crowding = 0.7f};
constexpr HairHairSettings kWet{
    .friction = 0.3f, .attraction = 0.1f, .repulsion = 0.3f, .crowding = 1.0f};

INSTANTIATE_TEST_SUITE_P(
    , HairOnHairRest,
    testing::Values(
        RestCase{"loose", Solver::shape, kLoose}, RestCase{"tight", Solver::shape, kTight},
        RestCase{"crowded", Solver::shape, kCrowded}, RestCase{"wet", Solver::shape, kWet},
        RestCase{"ftl", Solver::ftl, kLoose}, RestCase{"rod", Solver::rod, kLoose}),
    [](const auto& rest_case) { return rest_case.param.name; });

}  // namespace
}  // namespace hair::simulation
