#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "hair/reference/solvers.h"
#include "tests/simulation/strands.h"

namespace hair::simulation {

// Bounds the device's distance from the reference after some steps. The bound comes from the
// problem, not from the device: after every step a second reference gets float rounding in every
// vertex, and its distance from the first shows how the solver spreads one rounding a step.
struct Rounding {
    double spread;     // m
    double roundings;  // per vertex and step

    // The device rounds once per pull and sweep, independently, so its error grows with the square
    // root of their number. The factor of two allows for divisions and roots below float precision.
    double bound() const { return 2.0 * std::sqrt(roundings) * spread; }
};

// Returns the rounded corrections per vertex and step. If a solver treats a strand as a whole, each
// vertex collects the roundings of all vertices above it. One extra pass corrects the vertices that
// bodies pushed.
inline double pulls(const SimulationSettings& settings, std::uint32_t vertices_per_strand) {
    if (settings.solver == Solver::ftl) return vertices_per_strand;
    if (settings.length.method == LengthMethod::iterate)
        return settings.local.iterations + settings.length.iterations;
    return settings.local.iterations + vertices_per_strand * (settings.length.iterations + 1.0);
}

inline Rounding roundingAfter(
    int steps, const groom::Groom& groom, const SimulationSettings& settings, std::uint32_t seed) {
    reference::Reference solver(groom, settings, seed);
    reference::Reference rounded(groom, settings, seed);
    std::mt19937 random(1);
    for (int i = 0; i < steps; ++i) {
        solver.step();
        rounded.step();
        auto positions = std::vector(rounded.positions().begin(), rounded.positions().end());
        for (std::size_t v = 0; v < positions.size(); ++v)
            positions[v] *= glm::dvec3(1.0) + 0x1p-24 * randomVector(random);
        rounded.setState(
            positions, std::vector(rounded.previous().begin(), rounded.previous().end()));
    }
    return {
        largestDifference(rounded.positions(), solver.positions()),
        2.0 + 2.0 * pulls(settings, groom.vertices_per_strand)};
}

}  // namespace hair::simulation
