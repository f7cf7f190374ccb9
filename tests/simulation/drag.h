#pragma once

#include <cmath>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

#include "hair/groom/groom.h"
#include "hair/reference/wind.h"
#include "hair/settings.h"
#include "hair/simulation/solvers.h"
#include "tests/simulation/strands.h"

// Hair in air. By default nothing else acts on it.
namespace hair::simulation {

inline SimulationSettings inAir(float time_step) {
    SimulationSettings settings = nothingActs();
    settings.time_step = time_step;
    settings.wind.mode = WindMode::drag;
    return settings;
}

inline SimulationSettings fallingThroughAir(float time_step) {
    SimulationSettings settings = inAir(time_step);
    settings.gravity = {0.0f, -9.8f, 0.0f};
    return settings;
}

// Returns the accelerations, m/s^2, by air of a strand's free vertices in a substep at time 0.
inline std::vector<glm::dvec3> dragOnFree(
    std::span<const glm::dvec3> positions, std::span<const glm::dvec3> previous,
    const SimulationSettings& settings, std::uint32_t seed) {
    const double h = stepOf(settings).sub;
    const auto air = reference::airAt(positions, settings, seed, 0, 0.0).velocities;
    std::vector<glm::dvec3> velocities;
    for (std::size_t i = 0; i < positions.size(); ++i)
        velocities.push_back((positions[i] - previous[i]) / h);
    const auto rates =
        reference::dragRates(reference::tangentsAt(positions), velocities, air, settings);
    std::vector<glm::dvec3> accelerations;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::dvec3 pulled = velocities[i] + h * glm::dvec3(settings.gravity);
        accelerations.push_back((reference::withDrag(pulled, rates[i], air[i], h) - pulled) / h);
    }
    return accelerations;
}

// The effect of the fixed root moves one vertex further each step. The tip falls freely and level
// for that many steps.
inline constexpr std::uint32_t kLevelVertices = 64;
inline constexpr int kFreeSteps = 60;

// A strand along +x.
inline groom::Groom levelHair() {
    groom::Groom groom{.strand_count = 1, .vertices_per_strand = kLevelVertices};
    for (std::uint32_t v = 0; v < kLevelVertices; ++v) groom.points.emplace_back(0.01f * v, 0, 0);
    return groom;
}

// Returns the speed at which drag balances the weight, by bisection, m/s.
inline double fallingSpeed(const SimulationSettings& settings) {
    const double weight = glm::length(glm::dvec3(settings.gravity));
    double slow = 0.0;
    double fast = 100.0;
    for (int i = 0; i < 60; ++i) {
        const double speed = (slow + fast) / 2.0;
        const bool bears =
            reference::dragAcceleration(settings.wind, settings.material, speed) > weight;
        (bears ? fast : slow) = speed;
    }
    return slow;
}

// A tip in wind along z, held by a spring c = k / (1 - k). At 1/60 s the spring is the global
// constraint. Air stretches it by k(U) U h^2 / c = 3.5 mm, h = 1/60 s. This turns the 1 m segment
// so little that the wind across it falls by only 1e-5.
inline groom::Groom levelPair() {
    return {.strand_count = 1, .vertices_per_strand = 2, .points = {{0, 0, 0}, {1, 0, 0}}};
}

inline SimulationSettings onSpring(Solver solver, float time_step, std::uint32_t substeps) {
    SimulationSettings settings = inAir(time_step);
    settings.solver = solver;
    settings.substeps = substeps;
    settings.global.stiffness = 0.5f;
    settings.wind.direction = {0.0f, 0.0f, 1.0f};
    settings.wind.speed = 0.5f;
    return settings;
}

inline double springsStretch(const SimulationSettings& settings) {
    const double speed = settings.wind.speed;
    return reference::dragAcceleration(settings.wind, settings.material, speed) / 3600.0;
}

// Returns the number of steps until exp(-k / 2 t), k = 25/s, is below 1e-5.
inline int restingSteps(const SimulationSettings& settings) {
    return static_cast<int>(std::ceil(2.0 / double{settings.time_step})) + 20;
}

}  // namespace hair::simulation
