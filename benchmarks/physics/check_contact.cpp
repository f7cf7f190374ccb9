#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

#include "benchmarks/physics/checks.h"
#include "benchmarks/physics/experiment.h"
#include "hair/simulation/hair_hair.h"

namespace benchmarks::physics {
namespace {

// Two bundles that cross, far from their roots, and nothing else acts: what one gives the other it
// loses. Where they lie between the grid's cells is varied, for it is what repulsion's error
// depends on.

constexpr std::uint32_t kAcross = 5;  // strands of a bundle, each way
constexpr std::uint32_t kCrossingVertices = 33;
constexpr double kCrossingLength = 0.2;  // m
constexpr double kCrossingSpacing = 0.004;  // m
constexpr int kPlacements = 8;
constexpr double kClosing = 0.5;  // m/s, of each bundle toward the other
// Positions are rounded to 3e-8 m, a part in 10^5 of what friction changes in a step; the grids'
// integers leave less.
constexpr double kFrictionTolerance = 1e-4;

// One along x and one along z, that meet at their middles.
hair::groom::Groom crossing(double offset) {
    hair::groom::Groom groom{.vertices_per_strand = kCrossingVertices};
    for (int bundle = 0; bundle < 2; ++bundle)
        for (std::uint32_t row = 0; row < kAcross; ++row)
            for (std::uint32_t column = 0; column < kAcross; ++column) {
                ++groom.strand_count;
                for (std::uint32_t i = 0; i < kCrossingVertices; ++i) {
                    const double along =
                        kCrossingLength * (static_cast<double>(i) / (kCrossingVertices - 1) - 0.5);
                    const double beside =
                        kCrossingSpacing * (static_cast<double>(row) - 0.5 * (kAcross - 1));
                    const double height = kCrossingSpacing * column + offset;
                    if (bundle == 0)
                        groom.points.emplace_back(along, height, beside);
                    else
                        groom.points.emplace_back(beside, height + kCrossingSpacing, along);
                }
            }
    return groom;
}

// What all vertices but the roots gain in a step, over what they gain without regard to direction.
double momentumLost(
    const engine::Device& device, const hair::SimulationSettings& settings, double offset,
    double closing) {
    const hair::groom::Groom groom = crossing(offset);
    const std::vector<double> shares = hair::simulation::lengthShares(groom);
    std::vector<glm::dvec3> points(groom.points.begin(), groom.points.end());
    std::vector<glm::dvec3> velocities(points.size(), {0.0, closing, 0.0});
    for (std::size_t i = points.size() / 2; i < points.size(); ++i) velocities[i] *= -1.0;
    Experiment experiment(device, groom, settings);
    experiment.launch(points, velocities);
    experiment.advance(1);
    const std::vector<glm::dvec3> after = experiment.positions();
    glm::dvec3 sum(0.0);
    double total = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i % kCrossingVertices == 0) continue;
        const glm::dvec3 gained = (after[i] - points[i]) / experiment.timeStep() - velocities[i];
        sum += shares[i] * gained;
        total += shares[i] * glm::length(gained);
    }
    return glm::length(sum) / total;
}

double worstPlacement(
    const engine::Device& device, const hair::SimulationSettings& settings, double closing) {
    // Over one cell of a grid of this resolution, which is 1.1 lengths larger on every side.
    const double cell = 3.2 * kCrossingLength / settings.hair_hair.resolution;
    double lost = 0.0;
    for (int i = 0; i < kPlacements; ++i)
        lost = worst(lost, momentumLost(device, settings, cell * i / kPlacements, closing));
    return lost;
}

}  // namespace

void checkContactMomentum(const engine::Device& device, hair::Solver solver, Findings& findings) {
    if (const auto why = lack(solver, Need::free_vertices)) return findings.skip(*why);
    hair::SimulationSettings settings = freeHair(solver);
    settings.gravity = glm::vec3(0.0f);
    settings.local.stiffness = 0.0f;
    settings.length.iterations = 0;
    settings.hair_hair.resolution = 64;
    settings.hair_hair.crowding = 1.2f;

    settings.hair_hair.friction = 0.5f;
    findings.deviation(
        {"momentum that friction loses / exchanged", "1", {{"closing", kClosing, "m/s"}}},
        worstPlacement(device, settings, kClosing), kFrictionTolerance);
    settings.hair_hair.friction = 0.0f;
    settings.hair_hair.repulsion = 0.5f;
    findings.deviation(
        {"momentum that repulsion loses / exchanged", "1", {}},
        worstPlacement(device, settings, 0.0));
}

}  // namespace benchmarks::physics
