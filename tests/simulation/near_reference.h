#pragma once

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hair/reference/solvers.h"
#include "tests/simulation/gpu_simulation.h"
#include "tests/simulation/rounding.h"
#include "tests/simulation/strands.h"

namespace hair::simulation {

// Wind and a body with friction.
inline SimulationSettings windy() {
    SimulationSettings settings;
    settings.wind.strength = 10.0f;
    settings.collision = {.margin = 0.002f, .friction = 0.3f};
    settings.colliders = {{.a = {0, 0, 0}, .b = {0, 0.05f, 0}, .radius = 0.06f}};
    return settings;
}

// Compares a hundred steps of `shape`, with all its parts on, with the reference. The bound comes
// from the problem, not from the device: after every step a second reference gets float rounding in
// every vertex, and its distance from the first shows how the solver spreads one rounding a step.
// The device rounds once per pull and sweep, independently, so its error grows with the square root
// of their number. The factor of two allows for divisions and roots below float precision.
inline void expectNearReference(
    const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings) {
    const std::uint32_t vertices = groom.vertices_per_strand;
    Simulation simulation(device, groom, settings, 3);
    reference::Reference solver(groom, settings, 3);
    reference::Reference rounded(groom, settings, 3);
    std::mt19937 random(1);
    for (int i = 0; i < 100; ++i) {
        solver.step();
        rounded.step();
        auto positions = std::vector(rounded.positions().begin(), rounded.positions().end());
        for (std::size_t v = 0; v < positions.size(); ++v)
            if (v % vertices != 0) positions[v] *= glm::dvec3(1.0) + 0x1p-24 * randomVector(random);
        rounded.setState(
            positions, std::vector(rounded.previous().begin(), rounded.previous().end()));
    }
    advance(device, simulation, 100);
    const double spread = largestDifference(rounded.positions(), solver.positions());
    const double roundings = 2.0 + 2.0 * pulls(settings, vertices);
    const double error = largestDifference(simulation.readPositions(), solver.positions());
    EXPECT_LT(error, 2.0 * std::sqrt(roundings) * spread) << vertices << " vertices";
    EXPECT_LT(spread, 1e-4 * longestStrand(groom)) << vertices << " vertices";
}

}  // namespace hair::simulation
